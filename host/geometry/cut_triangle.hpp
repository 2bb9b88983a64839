// cut_triangle.hpp - a triangle cut into smaller ones along segments in it.
#pragma once

#include <set>
#include <vector>

#include "geometry/exact_plane.hpp"

namespace kreisel::core {

using Segment = std::array<std::uint32_t, 2>;

/// What a triangle is cut into.
struct TrianglePieces {
  std::vector<Triangle> triangles;  ///< as the whole one runs
  std::set<Segment> lines;  ///< edges of them, lower number first, that are of segments or the outline
};

/// Cuts a triangle along segments that may cross, touch and lie on each other. Each becomes edges of pieces,
/// from one point to the next. Points are known by the number that the caller gave them; the same place is
/// the same number. All signs are exact. By incremental insertion, edges turned towards Delaunay's [Lawson
/// 1977], which is looked at in double precision and without promise.
///
/// @param corners   of the triangle, which has area
/// @param segments  within it, of two points each
/// @param point     the point of that number
/// @param number    the number of a point that may be new: where two segments cross
[[nodiscard]] TrianglePieces cut_triangle(const Triangle& corners, const std::vector<Segment>& segments,
                                          const PointOf& point,
                                          const std::function<std::uint32_t(ExactPoint)>& number);

}  // namespace kreisel::core
