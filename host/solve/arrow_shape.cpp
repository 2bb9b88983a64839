#include "solve/arrow_shape.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace kreisel::core {
namespace {

/// Who is tied to whom, in one array.
class Neighbours {
 public:
  explicit Neighbours(const Pattern& p) : begin_(static_cast<std::size_t>(p.size) + 1) {
    const auto each = [&](auto&& take) {
      for (std::size_t e = 0; e < p.rows.size(); ++e)
        if (const int i = p.rows[e] - p.base, j = p.columns[e] - p.base; i != j) take(i, j), take(j, i);
    };
    each([&](int i, int) { ++begin_[static_cast<std::size_t>(i) + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    all_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    each([&](int i, int j) { all_[next[static_cast<std::size_t>(i)]++] = j; });
  }
  [[nodiscard]] std::span<const int> of(int i) const {
    const auto at = static_cast<std::size_t>(i);
    return std::span(all_).subspan(begin_[at], begin_[at + 1] - begin_[at]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<int> all_;
};

class ShapeSearch {
 public:
  explicit ShapeSearch(const Pattern& pattern)
      : size_(pattern.size),
        neighbours_(pattern),
        degree_(static_cast<std::size_t>(size_)),
        in_border_(static_cast<std::size_t>(size_)) {
    for (int i = 0; i < size_; ++i) degree(i) = static_cast<int>(neighbours_.of(i).size());
    const int tenable = std::clamp(size_ / 8, 64, 512);
    left_ = tenable;
  }

  std::optional<ArrowShape> run() {
    if (!take_long_rows()) return {};
    ArrowShape shape;
    std::vector<char> seen(in_border_);
    for (int i = 0; i < size_; ++i) {
      if (seen[static_cast<std::size_t>(i)]) continue;
      const std::vector<int> component = component_of(i, seen);
      if (component.size() <= arrow_block) {
        std::vector<int>& alike = shape.blocks[component.size() - 1];
        alike.insert(alike.end(), component.begin(), component.end());
      } else
        for (const int k : component)
          if (!take(k)) return {};
    }
    for (int i = 0; i < size_; ++i)
      if (in_border_[static_cast<std::size_t>(i)]) shape.border.push_back(i);
    return shape;
  }

 private:
  int& degree(int i) { return degree_[static_cast<std::size_t>(i)]; }

  bool take(int i) {
    in_border_[static_cast<std::size_t>(i)] = 1;
    for (const int j : neighbours_.of(i)) --degree(j);
    degree(i) = 0;
    return --left_ >= 0;
  }

  /// Halving the length that is long takes a logarithm of passes. A row that was long only because of those
  /// taken in the same pass is in the border for nothing, so the longest are taken by themselves.
  bool take_long_rows() {
    for (;;) {
      const int longest = *std::ranges::max_element(degree_);
      if (longest < arrow_block) return true;
      const int is_long = std::max(longest / 2, arrow_block - 1);
      std::vector<int> rows;
      for (int i = 0; i < size_; ++i)
        if (degree(i) > is_long) rows.push_back(i);
      for (const int i : rows)
        if (degree(i) > is_long && !take(i)) return false;
    }
  }

  std::vector<int> component_of(int first, std::vector<char>& seen) const {
    std::vector<int> all = {first};
    seen[static_cast<std::size_t>(first)] = 1;
    for (std::size_t k = 0; k < all.size(); ++k)
      for (const int j : neighbours_.of(all[k]))
        if (!std::exchange(seen[static_cast<std::size_t>(j)], 1)) all.push_back(j);
    std::ranges::sort(all);
    return all;
  }

  int size_, left_ = 0;
  Neighbours neighbours_;
  std::vector<int> degree_;  ///< of what is not in the border
  std::vector<char> in_border_;
};

}  // namespace

std::optional<ArrowShape> ArrowShape::of(const Pattern& pattern) {
  if (pattern.size == 0) return ArrowShape{};
  return ShapeSearch(pattern).run();
}

}  // namespace kreisel::core
