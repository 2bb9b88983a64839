// poured.hpp - what fills a mould: a casting, with the metal in its sprue and vents.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// An upright round channel.
struct Channel {
  Vec3 bottom;  ///< middle of its lower end
  double radius, top;
};

/// The union of a casting and its channels, by marching tetrahedra (mesh/make/march.hpp): a manifold free of
/// intersections. Vertices lie on the surfaces of both; edges are blunt by less than a cell.
///
/// @param casting  closed
/// @param cell     > 0; of channels less than their radius
[[nodiscard]] TriangleMesh poured(const TriangleMesh& casting, const std::vector<Channel>& channels,
                                  double cell);

}  // namespace kreisel::core
