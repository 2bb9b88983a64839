#include "mesh/query/embree_scene.hpp"

#include <algorithm>
#include <mutex>
#include <new>

namespace kreisel::core {

namespace {

/// The device of all scenes there are. It keeps tens of megabytes, so it goes with the last of them.
std::shared_ptr<RTCDeviceTy> shared_device() {
  static std::mutex opening;
  static std::weak_ptr<RTCDeviceTy> known;
  const std::scoped_lock lock(opening);
  std::shared_ptr<RTCDeviceTy> device = known.lock();
  if (!device) known = device = {rtcNewDevice("threads=1"), rtcReleaseDevice};
  return device;
}

}  // namespace

EmbreeScene::EmbreeScene(const TriangleMesh& mesh)
    : device_(shared_device()), scene_(rtcNewScene(device_.get())) {
  if (!mesh.vertices.empty()) middle_ = bounding_box(mesh).centre();
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  if (!vertices || !triangles) {
    rtcReleaseGeometry(geometry);
    rtcReleaseScene(scene_);
    throw std::bad_alloc();
  }
  for (const Vec3& v : mesh.vertices) {
    const Eigen::Vector3f at = local(v);
    vertices = std::copy(at.begin(), at.end(), vertices);
  }
  for (const Triangle& t : mesh.triangles) triangles = std::copy(t.begin(), t.end(), triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

}  // namespace kreisel::core
