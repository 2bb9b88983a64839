// plane.hpp - planes, and the halves that they cut.
#pragma once

#include "geometry/rotation.hpp"

namespace kreisel::core {

/// The points with normal . x = offset.
struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;

  /// How far a point lies beyond it, in lengths of the normal; negative on the other side.
  [[nodiscard]] double above(const Vec3& x) const { return normal.dot(x) - offset; }
  /// The same plane, seen from the other side.
  [[nodiscard]] Plane reversed() const { return {-normal, -offset}; }
  [[nodiscard]] Plane turned(const Eigen::Matrix3d& rotation) const { return {rotation * normal, offset}; }
};

/// The half beyond a plane as it leaves: two coordinates across the direction, then the height along it.
struct HalfView {
  Eigen::Matrix3d axes;  ///< rows; right-handed
  Plane cut;             ///< in these coordinates, into the half

  HalfView(const Plane& half, const Vec3& direction) : axes(axes_along(direction)), cut(half.turned(axes)) {}
  [[nodiscard]] Vec3 into(const Vec3& x) const { return axes * x; }
  [[nodiscard]] Vec3 out_of(const Vec3& x) const { return axes.transpose() * x; }
};

}  // namespace kreisel::core
