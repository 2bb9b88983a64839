// refine.hpp - shorter edges where a mesh is to be worked on.
#pragma once

#include <functional>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Splits edges in their middle, and their triangles with them, until `too_long` is true of none. The surface
/// stays where it is; closed, it stays closed. A triangle is always split across its longest side, too, so
/// that no angle becomes less than half of the smallest there was, and what is split is no more than what is
/// too long and its surroundings. [Rivara 1984]
/// @param too_long  of an edge by its ends, in either order; false for edges shorter than some length
void split_edges(TriangleMesh& mesh, const std::function<bool(const Vec3&, const Vec3&)>& too_long);

}  // namespace kreisel::core
