// statistics.hpp - of a handful of values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kreisel::core {

/// The middle value, of an even number the mean of both. @pre  one value or more
[[nodiscard]] inline double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::ranges::sort(values);
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace kreisel::core
