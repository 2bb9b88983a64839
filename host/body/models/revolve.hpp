// revolve.hpp - closed surfaces of revolution.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A circle of vertices about the z-axis; the first lies at y = 0, x = radius.
struct Ring {
  double radius, z;
  int count;  ///< 1 for a pole, where the radius is 0
};

/// Rings joined by triangles, from one pole to the other.
/// @param rings  at least three, from the pole below to the pole above, for triangles that face outward
[[nodiscard]] TriangleMesh revolve(const std::vector<Ring>& rings);

}  // namespace kreisel::core
