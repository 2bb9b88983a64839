// separate_edges.hpp - edges in which separate wedges of material merely touch.
#pragma once

#include <cstddef>

#include "mesh/triangle_mesh.hpp"

namespace kreisel {

/// Around an edge of four or more triangles that alternate between opening and closing a wedge of material,
/// each wedge gets vertices of its own, so that every edge has two triangles. Edges whose triangles do not
/// alternate, or lie on each other, stay. The order around the edge is exact (predicates.hpp).
/// @return  edges separated
std::size_t separate_edges(TriangleMesh& mesh);

}  // namespace kreisel
