// high_places.hpp - where air stays in a mould that is filled from below, or from its highest place.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The highest points of a solid and of its humps, seen along z, the highest first: what rises in the solid
/// ends there. A hump counts when it rises by at least `least` above the saddle over which it can be left
/// (its persistence). O(n log n).
///
/// @param solid  closed, normals outward; all of one shell
[[nodiscard]] std::vector<Vec3> high_places(const TriangleMesh& solid, double least);

}  // namespace kreisel::core
