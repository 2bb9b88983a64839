#include "solve/central_path.hpp"

#include <algorithm>
#include <cmath>

namespace kreisel::core {
namespace {

/// A symmetric matrix by rows.
struct Rows {
  std::vector<double> diagonal;
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> column;
  std::vector<double> value;

  Rows(std::size_t n, const SparseForm* form) : diagonal(n), first(n + 1) {
    if (!form) return;
    for (const auto& e : form->entries) {
      if (e.row == e.column) {
        diagonal[static_cast<std::size_t>(e.row)] += e.value;
        continue;
      }
      ++first[static_cast<std::size_t>(e.row) + 1];
      ++first[static_cast<std::size_t>(e.column) + 1];
    }
    for (std::size_t i = 0; i < n; ++i) first[i + 1] += first[i];
    column.resize(first[n]);
    value.resize(first[n]);
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    const auto put = [&](int row, int other, double v) {
      const std::size_t at = next[static_cast<std::size_t>(row)]++;
      column[at] = static_cast<std::uint32_t>(other);
      value[at] = v;
    };
    for (const auto& e : form->entries)
      if (e.row != e.column) {
        put(e.row, e.column, e.value);
        put(e.column, e.row, e.value);
      }
  }
};

/// The root between lower and upper of a + d x - barrier / (x - lower) + barrier / (upper - x), which grows:
/// Newton's method, kept between what is known to be too low and too high. @param x  between the bounds
double minimiser(double a, double d, double barrier, double lower, double upper, double x) {
  double low = lower, high = upper;
  constexpr int steps = 60;  // bisection alone would halve the range as often
  constexpr double still = 1e-9;
  for (int step = 0; step < steps; ++step) {
    const double from_low = barrier / (x - lower), from_high = barrier / (upper - x);
    const double value = a + d * x - from_low + from_high;
    (value > 0 ? high : low) = x;
    const double slope = d + from_low / (x - lower) + from_high / (upper - x);
    const double next = x - value / slope;
    // At the root a step is round-off, and may end on either side of what is known.
    if (std::abs(next - x) <= still * (upper - lower)) break;
    x = next > low && next < high ? next : (low + high) / 2;
  }
  return x;
}

}  // namespace

void to_central_path(std::span<double> x, std::span<const double> slope, const SparseForm* form,
                     const Bounds& bounds, double barrier) {
  const Rows rows(x.size(), form);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double width = bounds.upper[i] - bounds.lower[i];
    if (width > 0) x[i] = std::clamp(x[i], bounds.lower[i] + 1e-3 * width, bounds.upper[i] - 1e-3 * width);
  }
  constexpr int most_sweeps = 100;
  constexpr double still = 1e-3;  // of a variable's range
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (bounds.lower[i] == bounds.upper[i]) continue;
      double a = slope[i];
      for (std::size_t e = rows.first[i]; e < rows.first[i + 1]; ++e) a += rows.value[e] * x[rows.column[e]];
      const double next = minimiser(a, rows.diagonal[i], barrier, bounds.lower[i], bounds.upper[i], x[i]);
      largest = std::max(largest, std::abs(next - x[i]) / (bounds.upper[i] - bounds.lower[i]));
      x[i] = next;
    }
    if (largest < still) return;
  }
}

}  // namespace kreisel::core
