// convex_hull.hpp - the smallest convex solid around points of space.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A closed triangulated surface around points. Several facets may lie in one plane.
struct ConvexHull {
  std::vector<Vec3> vertices;    ///< those of the points that facets use
  std::vector<Triangle> facets;  ///< counter-clockwise seen from outside
  /// Of each facet the three beside it: the k-th across the edge from its corner k to its corner k + 1.
  std::vector<std::array<std::uint32_t, 3>> beside;

  [[nodiscard]] const Vec3& corner(std::size_t facet, std::size_t k) const {
    return vertices[facets[facet][k]];
  }
  /// Outward, of unit length.
  [[nodiscard]] Vec3 normal(std::size_t facet) const {
    const Vec3& a = corner(facet, 0);
    return (corner(facet, 1) - a).cross(corner(facet, 2) - a).normalized();
  }
};

/// Which points a facet sees is decided by exact signs, so that the surface is closed and convex up to the
/// rounding of nothing but the normals; where points are far out is measured in double. Expected O(n log n).
/// [Barber, Dobkin, Huhdanpaa 1996, The Quickhull Algorithm for Convex Hulls]
///
/// @return  without facets where all points lie in a plane
[[nodiscard]] ConvexHull convex_hull(std::span<const Vec3> points);

}  // namespace kreisel::core
