// wall.hpp - how thick the thinnest wall of a finished part is.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The least distance of a cavity's surface from the outer surface, in the unit of the meshes: exact at the
/// cavity's vertices and in the middle of every triangle. Infinite without a cavity.
///
/// Between those points the distance differs by no more than they are apart, and for facets that lie along
/// the outer surface by about edge^2 / (8 distance).
[[nodiscard]] double least_wall(const TriangleMesh& outer, const TriangleMesh& cavity);

/// The same of a part whose surface is that outer surface in places: at those of its vertices that lie
/// farther from it than `skin`. Infinite where there is none.
[[nodiscard]] double least_wall_within(const TriangleMesh& outer, const TriangleMesh& part, double skin);

}  // namespace kreisel::core
