// mesh.hpp - an indexed triangle mesh, and the ten numbers of a solid.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace kreisel {

using Vec3 = Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

/// Ten integrals of a solid, s_t = rho * integral of t over the solid, of 1 x y z xy yz xz xx yy zz.
/// Units: density times length^3 (the first), length^4 (the next three), length^5. [SpinIt, eq. 4]
using Moments = Eigen::Matrix<double, 10, 1>;

/// Vertices in the mesh's own length unit; triangles counter-clockwise seen from outside the material.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

}  // namespace kreisel
