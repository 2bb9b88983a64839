// repair.hpp - mends what can be mended without guessing, and says so.
#pragma once

#include <string>
#include <vector>

#include "mesh/solid/components.hpp"

namespace kreisel::core {

/// What was done, one line each ("merged 12 equal vertices"); empty when nothing was.
struct RepairReport {
  std::vector<std::string> lines;
};

/// The same solid with safe repairs, in this order:
/// - vertices with exactly equal coordinates become one, unless a closed surface would get edges of more
///   than two triangles by it;
/// - where edges are open, vertices at them no further than `weld` apart become one (weld.hpp);
/// - triangles that use a vertex twice go; those without area, and repeated ones, where no hole is left;
/// - where an edge has four or more triangles around separate wedges of material, each wedge, or else each
///   gap, gets vertices of its own (separate_edges.hpp);
/// - unused vertices go;
/// - in each shell, the fewest triangles turn so that all run the same way round; a shell for which there
///   is no such way (a Klein bottle) is left;
/// - where a triangle without area bridges a T-junction, it and its neighbour become two with area;
/// - outermost shells face outward, by turning each together with all it encloses.
/// Nothing moves by more than `weld` and no hole is filled: the result may still be no solid (solid.hpp).
/// @param weld  in units of the mesh, >= 0
[[nodiscard]] TriangleMesh repaired(TriangleMesh mesh, RepairReport& report, double weld = 0);

/// The last of these repairs alone, which is all there may be to do on a mesh that is spotless (check.hpp).
/// @param all  its shells  @return  whether any was turned
bool turn_outward(TriangleMesh& mesh, const std::vector<Shell>& all, RepairReport& report);

}  // namespace kreisel::core
