// embree_scene.hpp - a mesh as Embree sees it.
#pragma once

#include <embree3/rtcore.h>

#include <memory>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A scene, released with the object. All that there are at a time share one device.
class EmbreeScene {
 public:
  /// The triangles of a mesh in single precision, committed, for watertight rays and point queries. They lie
  /// about the middle of the mesh, so that it keeps its digits however far from the origin it is.
  explicit EmbreeScene(const TriangleMesh& mesh);
  ~EmbreeScene() { rtcReleaseScene(scene_); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  [[nodiscard]] RTCScene handle() const { return scene_; }
  /// A point of the mesh's coordinates in those of the scene.
  [[nodiscard]] Eigen::Vector3f local(const Vec3& p) const { return (p - middle_).cast<float>(); }

 private:
  std::shared_ptr<RTCDeviceTy> device_;
  RTCScene scene_;
  Vec3 middle_ = Vec3::Zero();
};

}  // namespace kreisel::core
