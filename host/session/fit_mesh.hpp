// fit_mesh.hpp - from the optimal quadric to a mesh that meets what was asked.
#pragma once

#include <cstddef>
#include <vector>

#include "session/make_part.hpp"

namespace kreisel::core {

/// What is inside the body, and the solids that are written.
struct MadePart {
  Inside inside;
  std::vector<MaterialPart> parts;
  std::size_t round = 0;  ///< of those that were printed, which it is
};

[[nodiscard]] MadePart made_of(const Body& body, Inside inside, const PartOptions& options);

/// Meshes what the optimal quadric leaves. A mesh and a sum over rays sample the same shape differently, and
/// fewer triangles do, too; to fit, the cut is moved until the mesh itself, or what is printed of it, meets
/// the constraints. Where that is farther than a cut may be moved as a mesh, what they differ by is added to
/// what is fixed, the problem solved again, and meshed anew. Says in the run's result what that costs.
/// @throws Interrupted
[[nodiscard]] MadePart mesh_inside(SolvedRun& run, bool fit, const PartOptions& options);

}  // namespace kreisel::core
