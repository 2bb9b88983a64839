// self_intersections.hpp - where a surface runs through itself.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Pairs of triangles (lower index first, sorted) that meet outside the corners and edges they share. Corners
/// with equal coordinates count as shared, so surfaces may touch along common edges. Triangles whose corners
/// lie on one line are passed over. The candidates are those whose boxes, rounded outward to single
/// precision, overlap (box_pairs.hpp); the decision is exact (triangle_pair.hpp): no pair is missed and none
/// is invented. O(n log n) for ordinary surfaces.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> self_intersections(const TriangleMesh& mesh);

}  // namespace kreisel::core
