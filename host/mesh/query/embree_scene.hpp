// embree_scene.hpp - a mesh as Embree sees it.
#pragma once

#include <embree3/rtcore.h>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The one device of the process: it keeps caches, and takes longer to open than a small scene to build. Any
/// thread may use it.
[[nodiscard]] RTCDevice embree_device();

/// A scene, released with the object.
class EmbreeScene {
 public:
  EmbreeScene() : scene_(rtcNewScene(embree_device())) {}
  /// The triangles of a mesh in single precision, committed, for watertight rays and point queries.
  explicit EmbreeScene(const TriangleMesh& mesh);
  ~EmbreeScene() { rtcReleaseScene(scene_); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Takes over a committed geometry, and builds the hierarchy.
  void commit(RTCGeometry geometry);
  [[nodiscard]] RTCScene handle() const { return scene_; }

 private:
  RTCScene scene_;
};

}  // namespace kreisel::core
