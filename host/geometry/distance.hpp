// distance.hpp - what of a segment or a triangle is nearest to a point.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/triangle.hpp"

namespace kreisel::core {

/// The point of a closed segment nearest to p, in the plane or in space. The ends may be one.
template <class Point>
[[nodiscard]] Point nearest_on_segment(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0;
  return a + t * ab;
}

/// Whether p lies between the planes that stand on the sides of a triangle. @param n  its normal, not zero
[[nodiscard]] inline bool stands_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c,
                                             const Vec3& n) {
  return (b - a).cross(p - a).dot(n) >= 0 && (c - b).cross(p - b).dot(n) >= 0 &&
         (a - c).cross(p - c).dot(n) >= 0;
}

/// Distance from a point to a closed triangle, which may be a segment or a point. Inline: a search among the
/// triangles of a mesh does little else.
[[nodiscard]] inline double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = normal_of(a, b, c);
  const double square = n.squaredNorm();
  if (square > 0 && stands_on_triangle(p, a, b, c, n)) return std::abs((p - a).dot(n)) / std::sqrt(square);
  return std::sqrt(std::min({(p - nearest_on_segment(p, a, b)).squaredNorm(),
                             (p - nearest_on_segment(p, b, c)).squaredNorm(),
                             (p - nearest_on_segment(p, c, a)).squaredNorm()}));
}

/// The point of it that is as near.
[[nodiscard]] inline Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = normal_of(a, b, c);
  const double square = n.squaredNorm();
  if (square > 0 && stands_on_triangle(p, a, b, c, n)) return p - n.dot(p - a) / square * n;
  return std::min(
      {nearest_on_segment(p, a, b), nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)},
      [&](const Vec3& q, const Vec3& r) { return (p - q).squaredNorm() < (p - r).squaredNorm(); });
}

}  // namespace kreisel::core
