// triangle_mesh.hpp - an indexed triangle mesh, nothing more.
#pragma once

#include "kreisel/mesh.hpp"

namespace kreisel::core {

using kreisel::Triangle;
using kreisel::Vec3;
using TriangleMesh = kreisel::Mesh;

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

}  // namespace kreisel::core
