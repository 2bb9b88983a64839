// refill_ends.hpp - flat ends of a solid triangulated anew.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The triangles in the plane of the lowest corner, and those in the plane of the highest, are replaced by
/// others between the same edges (fill_polygon.hpp). When coordinates were rounded since such an end was
/// made, an edge of it may pass on the wrong side of a corner that it nearly meets; filled anew it does not.
///
/// An end is left as it is where a corner lies inside it, or two of its outlines meet in one.
/// @throws InputError  outlines that cross
void refill_ends(TriangleMesh& mesh);

}  // namespace kreisel::core
