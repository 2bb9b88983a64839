// separate_edges.hpp - edges in which separate wedges of material merely touch.
#pragma once

#include <cstddef>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Around an edge of four or more triangles that alternate between opening and closing a wedge of material,
/// each wedge gets vertices of its own, so that every edge has two triangles. Where wedges hang together
/// around both ends, they are joined through the edge instead: then it is the gaps that get vertices of their
/// own. Edges for which neither helps, whose triangles do not alternate, or lie on each other, stay. The
/// order around the edge is exact (predicates.hpp).
/// @return  edges separated
std::size_t separate_edges(TriangleMesh& mesh);

}  // namespace kreisel::core
