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

/// The value that `share` of the others lie below; between two values in proportion. @pre  one value or more
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}

/// Half the distance from the first quartile to the third; 0 of one value. @pre  one value or more
[[nodiscard]] inline double half_interquartile_range(const std::vector<double>& values) {
  return (quantile(values, 0.75) - quantile(values, 0.25)) / 2;
}

}  // namespace kreisel::core
