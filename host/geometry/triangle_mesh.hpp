// triangle_mesh.hpp - an indexed triangle mesh, nothing more.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace kreisel {

using Vec3 = Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

/// Vertices in the mesh's own length unit; triangles counter-clockwise seen from outside the material.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// Axis-aligned bounding box.
struct Box {
  Vec3 lo, hi;
  [[nodiscard]] Vec3 extent() const { return hi - lo; }
};

/// Box of all vertices. The mesh has at least one.
[[nodiscard]] inline Box bounding_box(const TriangleMesh& mesh) {
  Box box{mesh.vertices.front(), mesh.vertices.front()};
  for (const Vec3& v : mesh.vertices) {
    box.lo = box.lo.cwiseMin(v);
    box.hi = box.hi.cwiseMax(v);
  }
  return box;
}

}  // namespace kreisel
