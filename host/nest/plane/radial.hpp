// radial.hpp - a polygon as seen from a point: how far its border is in every direction.
#pragma once

#include "geometry/polygon.hpp"

namespace kreisel::core::nest {

/// Where the rays from a point cross the border of a polygon. Single precision relative to the point, 1e-7 of
/// the distances; made anew by see() without allocating.
class Radial {
 public:
  /// @param directions  of the rays, kept by reference
  explicit Radial(const std::vector<Vec2>& directions);

  /// Every ray crosses the border of a polygon with `from` inside an odd number of times, otherwise an even
  /// number.
  void see(std::span<const Vec2> polygon, const Vec2& from);

  /// Distance to the nearest crossing of each direction; infinite where there is none.
  [[nodiscard]] const std::vector<float>& nearest() const { return slots_.front(); }
  /// Directions with more than one crossing.
  [[nodiscard]] const std::vector<int>& several() const { return several_; }
  /// Distances of all crossings of a direction, the nearest first.
  [[nodiscard]] std::span<const float> crossings(int direction) const;

 private:
  const std::vector<Vec2>& directions_;
  std::vector<std::vector<float>> slots_;  ///< of each crossing, of each direction
  std::vector<int> count_, several_;
  std::vector<std::size_t> begin_;  ///< in sorted_, of a direction with several
  std::vector<float> sorted_;
};

}  // namespace kreisel::core::nest
