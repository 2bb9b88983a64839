#include "mesh/query/embree_scene.hpp"

#include <algorithm>
#include <new>

namespace kreisel::core {

RTCDevice embree_device() {
  static const RTCDevice device = rtcNewDevice("threads=1");
  return device;
}

EmbreeScene::EmbreeScene(const TriangleMesh& mesh) : EmbreeScene() {
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  if (!vertices || !triangles) {
    rtcReleaseGeometry(geometry);
    throw std::bad_alloc();
  }
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(v[k]);
  for (const Triangle& t : mesh.triangles) triangles = std::copy(t.begin(), t.end(), triangles);
  rtcCommitGeometry(geometry);
  commit(geometry);
}

void EmbreeScene::commit(RTCGeometry geometry) {
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

}  // namespace kreisel::core
