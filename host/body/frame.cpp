#include "body/frame.hpp"

#include <Eigen/Geometry>

namespace kreisel::core {

Eigen::Matrix3d axis_to_z(const Vec3& axis) {
  return Eigen::Quaterniond::FromTwoVectors(axis, Vec3::UnitZ()).toRotationMatrix();
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
