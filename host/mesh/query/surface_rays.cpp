#include "mesh/query/surface_rays.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <new>

namespace kreisel::core {

struct SurfaceRays::Scene {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);
};

SurfaceRays::SurfaceRays(const TriangleMesh& mesh) : scene_(std::make_unique<Scene>()) {
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  if (!vertices || !triangles) throw std::bad_alloc();
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) *vertices++ = float(v[k]);
  for (const Triangle& t : mesh.triangles) triangles = std::copy(t.begin(), t.end(), triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_->scene);
}

SurfaceRays::~SurfaceRays() {
  rtcReleaseScene(scene_->scene);
  rtcReleaseDevice(scene_->device);
}

std::optional<SurfaceRays::Hit> SurfaceRays::first(const Vec3& from, const Vec3& direction, double least,
                                                   double most) const {
  if (!(least < most)) return std::nullopt;
  RTCRayHit ray{};
  ray.ray.org_x = float(from[0]), ray.ray.org_y = float(from[1]), ray.ray.org_z = float(from[2]);
  ray.ray.dir_x = float(direction[0]), ray.ray.dir_y = float(direction[1]),
  ray.ray.dir_z = float(direction[2]);
  ray.ray.tnear = float(least), ray.ray.tfar = float(most);
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const float along =
      ray.hit.Ng_x * ray.ray.dir_x + ray.hit.Ng_y * ray.ray.dir_y + ray.hit.Ng_z * ray.ray.dir_z;
  return Hit{double(ray.ray.tfar), along > 0};
}

}  // namespace kreisel::core
