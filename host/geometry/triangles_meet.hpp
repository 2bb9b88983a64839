// triangles_meet.hpp - the points that two triangles have in common.
#pragma once

#include <functional>
#include <vector>

#include "geometry/exact_plane.hpp"

namespace kreisel::core {

/// A triangle with the numbers of its corners; equal places have equal numbers. It has area.
struct CornersOf {
  Triangle number;
  std::array<Vec3, 3> at;
};

/// Segments, of two points, that both triangles hold, such that with their own edges they tell all of what
/// the two have in common; a point alone is a segment from it to itself. Exact (predicates.hpp,
/// exact_point.hpp).
/// @param point, number  of a number the point, of a point its number
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> triangles_meet(
    const CornersOf& s, const CornersOf& t, const PointOf& point,
    const std::function<std::uint32_t(ExactPoint)>& number);

}  // namespace kreisel::core
