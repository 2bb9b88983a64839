// nearest.hpp - which of the known names did a misspelt one mean?
#pragma once

#include <algorithm>
#include <concepts>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

namespace kreisel::core {

/// Letters to insert, delete, replace or swap with their neighbour to turn one word into the other (optimal
/// string alignment).
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

/// The candidate nearest to `name`, the first of equals; empty when none is close: more than a third of the
/// letters would change, so that a guess would only confuse.
template <std::ranges::input_range Names>
requires std::convertible_to<std::ranges::range_reference_t<const Names>, std::string_view>
[[nodiscard]] std::string nearest(std::string_view name, const Names& candidates) {
  std::string best;
  std::size_t least = 0;
  for (const auto& candidate : candidates) {
    const std::string_view word = candidate;
    const std::size_t distance = edit_distance(name, word);
    const bool close = 3 * distance <= std::max<std::size_t>(std::max(name.size(), word.size()), 3);
    if (!close || (!best.empty() && distance >= least)) continue;
    best = word;
    least = distance;
  }
  return best;
}

}  // namespace kreisel::core
