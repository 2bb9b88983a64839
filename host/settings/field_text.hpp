// field_text.hpp - fields of a run from text, and what a run is called after them.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "error.hpp"
#include "parse.hpp"

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

/// One of a few words, each of which stands for a value of an enumeration.
template <class Value>
using Words = std::vector<std::pair<std::string_view, Value>>;

template <class Value>
Value word(const Words<Value>& words, std::string_view key, std::string_view value) {
  for (const auto& [name, meaning] : words)
    if (name == value) return meaning;
  std::vector<std::string_view> names;
  for (const auto& [name, meaning] : words) names.push_back(name);
  const std::string last(names.back());
  names.pop_back();
  refuse(key, value, fmt::format("{} or {}", fmt::join(names, ", "), last));
}
template <class Value>
std::string word_for(const Words<Value>& words, const Value& value) {
  for (const auto& [name, meaning] : words)
    if (meaning == value) return std::string(name);
  return "";
}

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

inline std::string text_of(const Eigen::Vector3d& v) { return fmt::format("{},{},{}", v[0], v[1], v[2]); }

/// 32 bits that tell runs apart: FNV-1a over "key=value" lines, folded.
inline std::uint32_t hash(const std::map<std::string, std::string>& fields) {
  std::uint64_t h = 0xcbf29ce484222325ull;
  for (const auto& [key, value] : fields)
    for (const char c : key + "=" + value + "\n") h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return static_cast<std::uint32_t>(h ^ h >> 32);
}

}  // namespace kreisel::core::field_text
