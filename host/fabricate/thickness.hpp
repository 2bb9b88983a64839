// thickness.hpp - how thin the material between the surfaces of a part gets.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Where a part is thinnest.
struct ThinPlace {
  double thickness;  ///< infinite without a cavity
  Vec3 at = Vec3::Zero();
};

/// The least way from a cavity's surface straight through the material to the next surface, another one's or
/// the outer; from the middle of each of its triangles. Walls are that thick at least (wall.hpp says
/// exactly), webs between voids are found by this alone. Rays in single precision find the triangle, double
/// precision says how far it is; in the unit of the meshes.
[[nodiscard]] ThinPlace thinnest_material(const TriangleMesh& outer, const TriangleMesh& cavity);

}  // namespace kreisel::core
