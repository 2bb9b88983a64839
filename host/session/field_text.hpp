// field_text.hpp - fields of a run from text, and what a run is called after them.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
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
