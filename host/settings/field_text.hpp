// field_text.hpp - fields of a run from text, and what a run is called after them.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "error.hpp"
#include "parse.hpp"
#include "settings/field.hpp"

namespace kreisel::core::field_text {

[[noreturn]] inline void refuse(std::string_view key, std::string_view value, std::string_view expected) {
  throw InputError(fmt::format("{} = '{}'; expected {}", key, value, expected));
}

inline double number(std::string_view key, std::string_view value) {
  const auto result = parse<double>(value);
  if (!result) refuse(key, value, "a number");
  return *result;
}

inline int whole(std::string_view key, std::string_view value, int least) {
  const auto result = parse<int>(value);
  if (!result || *result < least) refuse(key, value, fmt::format("a whole number >= {}", least));
  return *result;
}

/// @param expected  what holds() asks for, in words
template <class Holds>
double number_where(std::string_view key, std::string_view value, std::string_view expected,
                    const Holds& holds) {
  const auto result = parse<double>(value);
  if (!result || !holds(*result)) refuse(key, value, expected);
  return *result;
}
inline double positive(std::string_view key, std::string_view value) {
  return number_where(key, value, "a number > 0", [](double v) { return v > 0; });
}
inline double not_negative(std::string_view key, std::string_view value) {
  return number_where(key, value, "a number >= 0", [](double v) { return v >= 0; });
}

inline std::string number_text(double v) { return fmt::format("{}", v); }
inline std::string number_text(const std::optional<double>& v) { return v ? number_text(*v) : ""; }

inline Eigen::Vector3d vector(std::string_view key, std::string_view value) {
  const auto v = parse_vector(value);
  if (!v) refuse(key, value, "three numbers x,y,z");
  return *v;
}

inline std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t cut; (cut = text.find(at)) != std::string_view::npos; text.remove_prefix(cut + 1))
    parts.push_back(text.substr(0, cut));
  parts.push_back(text);
  return parts;
}

/// "lower, middle or upper".
inline std::string either_of(std::vector<std::string_view> words) {
  const std::string last(words.back());
  words.pop_back();
  return words.empty() ? last : fmt::format("{} or {}", fmt::join(words, ", "), last);
}

/// The number of the word that the value is. @throws InputError  none of them
inline std::size_t word_of(std::string_view key, std::string_view value,
                           const std::vector<std::string_view>& words) {
  const auto found = std::ranges::find(words, value);
  if (found == words.end()) refuse(key, value, either_of(words));
  return static_cast<std::size_t>(found - words.begin());
}

inline Choices words_of(const std::vector<std::string_view>& words) {
  return [words] { return std::vector<std::string>(words.begin(), words.end()); };
}

template <class T>
struct Unwrapped {
  using type = T;
  static std::optional<std::size_t> number(const T& value) { return static_cast<std::size_t>(value); }
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using type = T;
  static std::optional<std::size_t> number(const std::optional<T>& value) {
    return value ? std::optional(static_cast<std::size_t>(*value)) : std::nullopt;
  }
};

/// A field whose value is one of some words.
/// @param get  what it sets of a T, const or not: a bool or enumerator, by the word's number; or an optional
///             one, which no word stands for where it is empty
template <class T, class Get>
[[nodiscard]] Field<T> one_of(std::string_view name, std::string_view help,
                              const std::vector<std::string_view>& words, Get get,
                              Identity identity = Identity::changed) {
  using Value = Unwrapped<std::remove_cvref_t<decltype(get(std::declval<T&>()))>>;
  return {name,
          "",
          help,
          [words, get](T& run, std::string_view key, std::string_view value) {
            get(run) = static_cast<typename Value::type>(word_of(key, value, words));
          },
          [words, get](const T& run) {
            const std::optional<std::size_t> number = Value::number(get(run));
            return number ? std::string(words[*number]) : std::string();
          },
          identity,
          1,
          false,
          "",
          words_of(words)};
}

inline std::string text_of(const Eigen::Vector3d& v) { return fmt::format("{},{},{}", v[0], v[1], v[2]); }

/// 32 bits that tell runs apart: FNV-1a over "key=value" lines, folded.
inline std::uint32_t hash(const std::map<std::string, std::string>& fields) {
  std::uint64_t h = 0xcbf29ce484222325ull;
  for (const auto& [key, value] : fields)
    for (const char c : key + "=" + value + "\n") h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return static_cast<std::uint32_t>(h ^ h >> 32);
}

}  // namespace kreisel::core::field_text
