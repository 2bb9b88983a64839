// triangle.hpp - one triangle of a mesh in space.
#pragma once

#include <Eigen/Geometry>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

[[nodiscard]] inline std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// To the side from which a, b, c run counter-clockwise; as long as twice the area.
[[nodiscard]] inline Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}
[[nodiscard]] inline Vec3 normal_of(const TriangleMesh& mesh, const Triangle& t) {
  return normal_of(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
}

/// The mean of its corners.
[[nodiscard]] inline Vec3 middle_of(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
}

}  // namespace kreisel::core
