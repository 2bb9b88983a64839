// weld.hpp - corners that round-off keeps apart.
#pragma once

#include <cstddef>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Joins vertices no further than `within` from each other to the first of them, where edges are open: what
/// is closed needs no mending, however narrow its slits are. Triangles that then name a vertex twice go. The
/// mesh is left as it is where the joined one has no fewer open edges.
/// @param within  in units of the mesh; 0: nothing is done
/// @return  how many vertices were joined to others
std::size_t weld_open_edges(TriangleMesh& mesh, double within);

}  // namespace kreisel::core
