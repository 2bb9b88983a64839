// flip_flat.hpp - triangles without area that bridge a T-junction.
#pragma once

#include <cstddef>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Where a triangle's middle corner lies exactly on its opposite side, turns that side so that the corner
/// splits the neighbour across it: two triangles with area instead of one with and one without, over the same
/// points. Stays where the neighbour has no area either, runs the other way round, or the new side exists
/// already.
/// @return  triangles without area that are gone
std::size_t flip_flat_triangles(TriangleMesh& mesh);

}  // namespace kreisel::core
