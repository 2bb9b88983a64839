#include "body/frame.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace kreisel::core {

Eigen::Matrix3d axis_to_z(const Vec3& axis) {
  const Vec3 from = axis.normalized();
  if (from[2] < -1 + 1e-6) {  // half a turn, about any horizontal axis, and what is left
    const Eigen::DiagonalMatrix<double, 3> half(1, -1, -1);
    return axis_to_z(half * from) * half;
  }
  // The half angle's cosine, and its sine along the axis. Not Eigen's FromTwoVectors, which brings a
  // decomposition along.
  const double cosine = std::sqrt((1 + from[2]) / 2);
  const Vec3 sine = from.cross(Vec3::UnitZ()) / (2 * cosine);
  return Eigen::Quaterniond(cosine, sine[0], sine[1], sine[2]).normalized().toRotationMatrix();
}

TriangleMesh to_body(const Frame& frame, TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v = frame.to_body(v);
  return mesh;
}

TriangleMesh to_model(const Frame& frame, TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v = frame.to_model(v);
  return mesh;
}

}  // namespace kreisel::core
