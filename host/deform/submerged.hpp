// submerged.hpp - what of a mesh lies under water, and how that changes as it moves.
#pragma once

#include <vector>

#include "body/moments.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Volume and first moments along x and y of what lies below a plane; the others are zero. In units of the
/// mesh, about its origin. Exact: triangles are clipped, and a closed mesh needs no cap for tetrahedra whose
/// tip lies in the plane.
/// @param surface  z of the plane
[[nodiscard]] Moments submerged(const TriangleMesh& mesh, double surface);

/// The derivative of q . submerged() in every vertex, for a q of 1, x and y alone; the plane stays.
[[nodiscard]] std::vector<Vec3> submerged_gradient(const TriangleMesh& mesh, double surface,
                                                   const Moments& q);

}  // namespace kreisel::core
