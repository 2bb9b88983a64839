// orient.hpp - the same way round everywhere, and outward.
#pragma once

#include <cstddef>

#include "mesh/solid/components.hpp"

namespace kreisel::core {

/// In each shell turns the fewest triangles such that all run the same way round; a shell for which there is
/// no such way (a Klein bottle) stays as it is.
/// @return  triangles turned
std::size_t orient_shells(TriangleMesh& mesh);

/// Turns each outermost shell that faces inward, and all that it encloses with it. The mesh is closed and
/// each shell oriented.
/// @param all  the shells of the mesh
/// @return     shells turned
std::size_t face_outward(TriangleMesh& mesh, const std::vector<Shell>& all);

}  // namespace kreisel::core
