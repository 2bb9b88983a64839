// mesh.hpp - an indexed triangle mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kreisel/moments.hpp"

namespace kreisel {

using Triangle = std::array<std::uint32_t, 3>;

/// Vertices in the mesh's own length unit; triangles counter-clockwise seen from outside the material.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

}  // namespace kreisel
