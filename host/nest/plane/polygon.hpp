// polygon.hpp - outlines of shapes, and what of one lies open to a horizontal cut.
#pragma once

#include "geometry/polygon.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core::nest {

/// The outline of a mesh, seen with `towards` pointing from it to the eye and `up` upwards: the largest
/// piece, its holes filled. Pixels decide what is covered; their border is then straightened by less than a
/// pixel.
///
/// @param pixels  along the longest side, 8 to 8192
/// @throws InputError  a mesh that covers no pixel, directions that are no plane, pixels out of range
[[nodiscard]] Polygon silhouette(const TriangleMesh& mesh, const Vec3& towards, const Vec3& up, int pixels);

/// A part of what can be reached, from a horizontal cut within a polygon, straight upwards and downwards
/// without leaving it: the part about the piece of the cut from x0 to x1.
struct OpenPart {
  double x0, x1;
  Polygon outline;  ///< counter-clockwise
};

/// All of them at that height, from left to right. O(vertices^2).
[[nodiscard]] std::vector<OpenPart> open_to(std::span<const Vec2> polygon, double height);

}  // namespace kreisel::core::nest
