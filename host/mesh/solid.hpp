// solid.hpp - from any mesh of a file to the boundary of a solid, or a clear refusal.
#pragma once

#include <string_view>

#include "mesh/repair.hpp"

namespace kreisel {

/// repaired(), then every check: closed, two triangles at every edge, orientable, of non-zero volume
/// (require_solid()); not running through itself; shells within shells facing inward and outward in turn.
///
/// @param name    what messages call the mesh
/// @param report  the repairs, and how many cavities the solid has
/// @throws InputError  the first check that fails; one line with number and place
[[nodiscard]] TriangleMesh make_solid(TriangleMesh mesh, std::string_view name, RepairReport& report);

/// @throws InputError  with the number of pairs and the first, when the surface runs through itself
void require_no_self_intersections(const TriangleMesh& mesh, std::string_view name);

/// For a mesh that passes require_solid() and does not run through itself.
/// @return  the number of cavities: shells inside another that face inward
/// @throws InputError  a shell faces the same way as the one around it
std::size_t require_alternating_shells(const TriangleMesh& mesh, std::string_view name);

}  // namespace kreisel
