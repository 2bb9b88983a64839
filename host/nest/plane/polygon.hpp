// polygon.hpp - plane shapes: outlines, and what of one lies open to a horizontal cut.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core::nest {

using Vec2 = Eigen::Vector2d;

/// A simple polygon, counter-clockwise.
using Polygon = std::vector<Vec2>;

[[nodiscard]] double area(std::span<const Vec2> polygon);  ///< > 0 when counter-clockwise
[[nodiscard]] Vec2 centroid(std::span<const Vec2> polygon);

/// The outline of a mesh, seen with `towards` pointing from it to the eye and `up` upwards: the largest
/// piece, its holes filled. Pixels decide what is covered; their border is then straightened by less than a
/// pixel.
///
/// @param pixels  along the longest side, 8 to 8192
/// @throws InputError  a mesh that covers no pixel, directions that are no plane, pixels out of range
[[nodiscard]] Polygon silhouette(const TriangleMesh& mesh, const Vec3& towards, const Vec3& up, int pixels);

/// A solid of that outline: z from -height/2 to height/2.
/// @throws InputError  a polygon that crosses itself
[[nodiscard]] TriangleMesh prism(std::span<const Vec2> polygon, double height);

/// A part of what can be reached, from a horizontal cut within a polygon, straight upwards and downwards
/// without leaving it: the part about the piece of the cut from x0 to x1.
struct OpenPart {
  double x0, x1;
  Polygon outline;  ///< counter-clockwise
};

/// All of them at that height, from left to right. O(vertices^2).
[[nodiscard]] std::vector<OpenPart> open_to(std::span<const Vec2> polygon, double height);

}  // namespace kreisel::core::nest
