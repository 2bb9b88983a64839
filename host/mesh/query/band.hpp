// band.hpp - a few rows of vertical lines, while parts are taken out of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/query/offset.hpp"

namespace kreisel::core {

/// Lines of a band in a box, and the heights of the box.
struct Window {
  int i0 = 0, i1 = -1, j0 = 0, j1 = -1;  ///< closed ranges
  double z0 = 0, z1 = 0;
};

/// The lines of rows [first, end) of a raster. What is left of a line lies between two ends, less the gaps
/// there; most lines never have any.
class Band {
 public:
  Band(const LineRaster& raster, int first, int end, const LineSpans& lines)
      : raster_(raster), per_h_(1 / raster.h), first_(first), end_(end) {
    const std::size_t count = static_cast<std::size_t>(end - first) * raster.nx;
    low_.resize(count, infinity);
    high_.resize(count, -infinity);
    gaps_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto spans = lines[static_cast<std::size_t>(first) * raster.nx + i];
      if (spans.empty()) continue;
      low_[i] = spans.front().z0;
      high_[i] = spans.back().z1;
      for (std::size_t k = 1; k < spans.size(); ++k) gaps_[i].push_back({spans[k - 1].z1, spans[k].z0});
    }
    x_.resize(static_cast<std::size_t>(raster.nx));
    for (int i = 0; i < raster.nx; ++i) x_[static_cast<std::size_t>(i)] = raster.x(i);
  }

  [[nodiscard]] Window window(const Box& box) const {
    return {std::max(0, column_from(box.lo[0])),
            std::min(raster_.nx - 1, column_to(box.hi[0])),
            std::max(first_, row_from(box.lo[1])),
            std::min(end_ - 1, row_to(box.hi[1])),
            box.lo[2],
            box.hi[2]};
  }

  /// Is anything left in a window?
  [[nodiscard]] bool reaches(const Window& w) const {
    for (int j = w.j0; j <= w.j1; ++j)
      for (int i = w.i0; i <= w.i1; ++i)
        if (const std::size_t at = line(i, j); low_[at] < w.z1 && high_[at] > w.z0) return true;
    return false;
  }

  void remove_ball(const Vec3& centre, double radius) {
    const int j0 = std::max(first_, row_from(centre[1] - radius));
    const int j1 = std::min(end_ - 1, row_to(centre[1] + radius));
    for (int j = j0; j <= j1; ++j) {
      const double dy = raster_.y(j) - centre[1], square = radius * radius - dy * dy;
      if (!(square > 0)) continue;
      const double half = std::sqrt(square);
      const int i0 = std::max(0, column_from(centre[0] - half));
      const int i1 = std::min(raster_.nx - 1, column_to(centre[0] + half));
      for (int i = i0; i <= i1; ++i) {
        const std::size_t at = line(i, j);
        const double dx = x_[static_cast<std::size_t>(i)] - centre[0], rest = square - dx * dx;
        const double away = std::max({low_[at] - centre[2], centre[2] - high_[at], 0.0});
        if (!(away * away < rest)) continue;
        const double reach = std::sqrt(rest);
        remove(at, {centre[2] - reach, centre[2] + reach});
      }
    }
  }

  /// Takes a shape out of the lines of a window of which anything is left there.
  /// @param shape  as in reach.hpp
  template <class Shape>
  void remove(const Shape& shape, Window w) {
    // To narrow a window of a few lines costs more than to ask them.
    constexpr int few = 4;
    if (w.j1 - w.j0 > few) {
      const auto [y0, y1] = shape.rows();
      w.j0 = std::max(w.j0, row_from(y0));
      w.j1 = std::min(w.j1, row_to(y1));
    }
    for (int j = w.j0; j <= w.j1; ++j) {
      const double y = raster_.y(j);
      int i0 = w.i0, i1 = w.i1;
      if (i1 - i0 > few) {
        const auto [x0, x1] = shape.columns(y);
        i0 = std::max(i0, column_from(x0));
        i1 = std::min(i1, column_to(x1));
      }
      for (int i = i0; i <= i1; ++i) {
        const std::size_t at = line(i, j);
        if (!(low_[at] < w.z1 && high_[at] > w.z0)) continue;
        const Span span = shape.span(x_[static_cast<std::size_t>(i)], y);
        if (span.z0 < span.z1 && span.z0 < high_[at] && span.z1 > low_[at]) remove(at, span);
      }
    }
  }

  /// What is left, line by line, without parts shorter than `least`.
  [[nodiscard]] LineSpans left(double least) const {
    LineSpans left;
    left.first.reserve(low_.size() + 1);
    for (std::size_t at = 0; at < low_.size(); ++at) {
      double from = low_[at];
      const auto add = [&](double to) {
        if (to - from >= least) left.spans.push_back({from, to});
      };
      for (const Span& gap : gaps_[at]) {
        add(gap.z0);
        from = gap.z1;
      }
      add(high_[at]);
      left.end_line();
    }
    return left;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  [[nodiscard]] std::size_t line(int i, int j) const {
    return static_cast<std::size_t>(j - first_) * raster_.nx + i;
  }
  /// A line on the rim of a shape must not be missed for the rounding of its place in the raster.
  static constexpr double slack = 1e-6;
  static int at_least(double i) {
    const int down = static_cast<int>(std::clamp(i - slack, -1.0, 1e9));
    return down + (down < i - slack);
  }
  static int at_most(double i) { return static_cast<int>(std::clamp(i + slack, -1.0, 1e9) + 1) - 1; }
  [[nodiscard]] int column_from(double x) const { return at_least((x - raster_.x0) * per_h_); }
  [[nodiscard]] int column_to(double x) const { return at_most((x - raster_.x0) * per_h_); }
  [[nodiscard]] int row_from(double y) const { return at_least((y - raster_.y0) * per_h_); }
  [[nodiscard]] int row_to(double y) const { return at_most((y - raster_.y0) * per_h_); }

  void remove(std::size_t at, Span out) {
    double &low = low_[at], &high = high_[at];
    std::vector<Span>& gaps = gaps_[at];
    // Gaps that meet it become one with it.
    const auto from = std::find_if(gaps.begin(), gaps.end(), [&](const Span& g) { return g.z1 >= out.z0; });
    auto to = from;
    for (; to != gaps.end() && to->z0 <= out.z1; ++to) {
      out.z0 = std::min(out.z0, to->z0);
      out.z1 = std::max(out.z1, to->z1);
    }
    const bool at_low = out.z0 <= low, at_high = out.z1 >= high;
    if (at_low && at_high) {
      low = infinity;
      high = -infinity;
      gaps.clear();
    } else if (at_low) {
      low = out.z1;
      gaps.erase(gaps.begin(), to);
    } else if (at_high) {
      high = out.z0;
      gaps.erase(from, gaps.end());
    } else if (from == to) {
      gaps.insert(from, out);
    } else {
      *from = out;
      gaps.erase(from + 1, to);
    }
  }

  const LineRaster& raster_;
  double per_h_;
  int first_, end_;
  std::vector<double> low_, high_;       ///< ends of what is left; nothing where not low < high
  std::vector<std::vector<Span>> gaps_;  ///< between them: disjoint, in ascending order
  std::vector<double> x_;
};

}  // namespace kreisel::core
