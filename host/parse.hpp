// parse.hpp - numbers from text, the whole of it or nothing; never looks at the locale.
#pragma once

#include <Eigen/Core>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

namespace kreisel::core {

/// `text` as a number, or nothing if any part of it is not one, or if it is not finite.
template <class Number>
std::optional<Number> parse(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) return std::nullopt;
  return value;
}

/// A number that ends in a unit, such as "60%": the number, if `text` ends in `unit` and the rest is one.
inline std::optional<double> parse_with_unit(std::string_view text, std::string_view unit) {
  if (!text.ends_with(unit)) return std::nullopt;
  return parse<double>(text.substr(0, text.size() - unit.size()));
}

/// "x,y,z".
inline std::optional<Eigen::Vector3d> parse_vector(std::string_view text) {
  Eigen::Vector3d v;
  for (int a = 0; a < 3; ++a) {
    const std::size_t comma = text.find(',');
    const auto number = parse<double>(text.substr(0, comma));
    if (!number || (comma == std::string_view::npos) != (a == 2)) return std::nullopt;
    v[a] = *number;
    if (a < 2) text.remove_prefix(comma + 1);
  }
  return v;
}

}  // namespace kreisel::core
