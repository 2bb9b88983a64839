// exact_plane.hpp - numbered points in the plane of a triangle.
#pragma once

#include <functional>

#include "geometry/exact_point.hpp"
#include "geometry/predicates.hpp"

namespace kreisel::core {

/// The point of a number; the same place has the same number.
using PointOf = std::function<const ExactPoint&(std::uint32_t)>;

/// A plane seen such that a triangle in it runs counter-clockwise.
class ExactPlane {
 public:
  /// @param corners  of a triangle with area, its points with double coordinates  @param point  outlives this
  ExactPlane(const Triangle& corners, const PointOf& point) : point_(point) {
    const Vec3 &a = point(corners[0]).near(), &b = point(corners[1]).near(), &c = point(corners[2]).near();
    axis_ = projection_axis(a, b, c);
    turned_ = orient2d(drop(a, axis_), drop(b, axis_), drop(c, axis_)) < 0;
  }

  /// The axis without which the points are still apart.
  [[nodiscard]] int axis() const { return axis_; }
  /// 1 when c lies left of the line from a to b, 0 on it, -1 right of it.
  [[nodiscard]] int orient(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const int sign = orient2d(point_(a), point_(b), point_(c), axis_);
    return turned_ ? -sign : sign;
  }
  /// About where it lies.
  [[nodiscard]] Vec2 near(std::uint32_t p) const {
    const Vec2 at = drop(point_(p).near(), axis_);
    return turned_ ? Vec2(at[1], at[0]) : at;
  }
  [[nodiscard]] const ExactPoint& exact(std::uint32_t p) const { return point_(p); }

 private:
  const PointOf& point_;
  int axis_;
  bool turned_;
};

}  // namespace kreisel::core
