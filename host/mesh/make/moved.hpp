// moved.hpp - a mesh somewhere else.
#pragma once

#include <Eigen/Geometry>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Every vertex through the map.
[[nodiscard]] inline TriangleMesh moved(TriangleMesh mesh, const Eigen::Affine3d& map) {
  for (Vec3& v : mesh.vertices) v = map * v;
  return mesh;
}

}  // namespace kreisel::core
