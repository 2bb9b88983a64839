// cut_plane.hpp - a solid cut by a horizontal plane, and closed again.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mesh/fill_polygon.hpp"
#include "mesh/triangle_mesh.hpp"

namespace kreisel {

/// A blind hole from the cut upwards: a prism over a polygon.
struct BlindHole {
  std::vector<Point2> polygon;  ///< counter-clockwise seen from above; empty: none
  double depth = 0;             ///< > 0
};

/// The part of a solid above the plane z = height, closed by a flat cap, with a blind hole in it. The plane
/// is moved up by as little as it takes to clear all vertices, less than 1e-6 of the mesh's size, so that it
/// cuts edges alone: the surface along the cut stays a manifold.
///
/// @return  empty where nothing is above
/// @throws InputError  the hole's polygon does not lie inside the section; a section that crosses itself
[[nodiscard]] TriangleMesh above_plane(const TriangleMesh& solid, double height, const BlindHole& hole = {});

/// The same with several holes, which must not touch each other. One without a polygon is none.
///
/// @param round  where the corners of the cap come to lie, as a file's precision will have it: the cap is
///               filled with triangles between those, so that none folds over when it is written. Corners
///               that become one are one. The cap then is flat up to that precision.
[[nodiscard]] TriangleMesh above_plane(const TriangleMesh& solid, double height,
                                       std::span<const BlindHole> holes,
                                       const std::function<Vec3(const Vec3&)>& round = {});

}  // namespace kreisel
