// cut_plane.hpp - a solid cut by a horizontal plane, and closed again.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "geometry/fill_polygon.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A blind hole from the cut upwards: a prism over a polygon.
struct BlindHole {
  Polygon polygon;   ///< counter-clockwise seen from above; empty: none
  double depth = 0;  ///< > 0
};

/// The part of a solid above the plane z = height, closed by a flat cap, with a blind hole in it. The plane
/// is moved up by as little as it takes to clear all vertices, less than 1e-6 of the mesh's size, so that it
/// cuts edges alone: the surface along the cut stays a manifold.
///
/// @return  empty where nothing is above
/// @throws InputError  the hole's polygon does not lie inside the section; a section that crosses itself
[[nodiscard]] TriangleMesh above_plane(const TriangleMesh& solid, double height, const BlindHole& hole = {});

/// How corners will be written, where that is in another coordinate system or rounded.
struct WrittenAs {
  /// Where a corner of the cap comes to lie, in the coordinates of the cut. Corners that become one are one.
  std::function<Vec3(const Vec3&)> rounded;
  /// Two of the written coordinates of such a corner, those across which the cap keeps its area, in the order
  /// in which it is seen from below.
  std::function<Vec2(const Vec3&)> flat;
};

/// The same with several holes, which must not touch each other. One without a polygon is none.
///
/// @param written  the cap is filled with triangles between the corners as they will be written, so that none
///                 folds over or loses its area by that. It is flat up to the rounding.
[[nodiscard]] TriangleMesh above_plane(const TriangleMesh& solid, double height,
                                       std::span<const BlindHole> holes, const WrittenAs& written = {});

}  // namespace kreisel::core
