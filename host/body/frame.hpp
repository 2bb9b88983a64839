// frame.hpp - the map between a model's own coordinates and the body frame every solver works in.
#pragma once

#include "geometry/rotation.hpp"

namespace kreisel::core {

/// Body coordinates X = R (x - origin) / length: z along the axis, origin at the contact point, unit length
/// L = V^(1/3) of the solid.
struct Frame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 origin = Vec3::Zero();
  double length = 1;  ///< model units in one body unit

  [[nodiscard]] Vec3 to_body(const Vec3& x) const { return rotation * (x - origin) / length; }
  [[nodiscard]] Vec3 to_model(const Vec3& X) const { return rotation.transpose() * X * length + origin; }
};

/// Every vertex through to_body or to_model.
[[nodiscard]] TriangleMesh to_body(const Frame& frame, TriangleMesh mesh);
[[nodiscard]] TriangleMesh to_model(const Frame& frame, TriangleMesh mesh);

}  // namespace kreisel::core
