// solid.hpp - from any mesh of a file to the boundary of a solid, or a clear refusal.
#pragma once

#include <string_view>

#include "kreisel/mending.hpp"
#include "mesh/solid/pieces.hpp"
#include "mesh/solid/surface.hpp"

namespace kreisel::core {

/// A mesh that bounds a solid, and how it came to.
struct SolidMesh {
  TriangleMesh mesh;
  RepairReport repairs;       ///< and how many cavities the solid has
  std::vector<Piece> pieces;  ///< all that there are, largest first; of the mesh those that are meant
};

using kreisel::Mending;

/// The mesh of the surface, which gives it away, after every check: closed, two triangles at every edge,
/// orientable, of non-zero volume (require_solid()); not running through itself; shells within shells facing
/// inward and outward in turn. Ahead of these, holes are closed where that is wanted (close_holes.hpp); a
/// surface that runs through itself, or lies within itself, becomes the boundary of all that it encloses
/// (unite.hpp).
///
/// @param name         what messages call the mesh
/// @param mending      what is allowed; of its pieces those that are meant are kept, without it all
/// @param millimetres  one unit of the mesh
/// @throws InputError  the first check that fails; one line with number and place
[[nodiscard]] SolidMesh make_solid(Surface& surface, std::string_view name, const Mending& mending = {},
                                   double millimetres = 1);

/// The same checks of a mesh that needs no mending.
/// @throws InputError  as make_solid()
void require_sound(const TriangleMesh& mesh, std::string_view name);

/// The same of a mesh as it is read, which is mended first (repair.hpp).
[[nodiscard]] SolidMesh make_solid(TriangleMesh mesh, std::string_view name, const Mending& mending = {});

}  // namespace kreisel::core
