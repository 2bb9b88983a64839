// statistics.hpp - of a handful of values.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace kreisel::core {

/// The middle value, of an even number the mean of both. @pre  one value or more
[[nodiscard]] inline double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::ranges::sort(values);
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// Half the distance from the first quartile to the third, quartiles interpolated linearly; 0 of one value.
/// @pre  one value or more
[[nodiscard]] inline double half_interquartile_range(std::vector<double> values) {
  std::ranges::sort(values);
  const auto quartile = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
  };
  return (quartile(0.75) - quartile(0.25)) / 2;
}

}  // namespace kreisel::core
