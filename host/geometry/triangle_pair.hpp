// triangle_pair.hpp - do two triangles meet where they should not?
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Three corners and the numbers they go by; equal numbers are the same corner.
struct NumberedTriangle {
  Triangle number;
  std::array<Vec3, 3> corner;
};

/// Whether two triangles have a point in common that is not of a shared corner or a shared edge. Touching
/// counts, so do coplanar neighbours that fold onto each other, and triangles that share all three corners.
/// Exact (predicates.hpp). Both triangles have area.
[[nodiscard]] bool intersect_improperly(const NumberedTriangle& s, const NumberedTriangle& t);

}  // namespace kreisel::core
