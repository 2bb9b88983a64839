#include "mesh/query/surface_rays.hpp"

#include "mesh/query/embree_scene.hpp"

namespace kreisel::core {

SurfaceRays::SurfaceRays(const TriangleMesh& mesh) : scene_(std::make_unique<EmbreeScene>(mesh)) {}

SurfaceRays::~SurfaceRays() = default;

std::optional<SurfaceRays::Hit> SurfaceRays::first(const Vec3& from, const Vec3& direction, double least,
                                                   double most) const {
  if (!(least < most)) return std::nullopt;
  RTCRayHit ray{};
  const Eigen::Vector3f at = scene_->local(from);
  ray.ray.org_x = at[0], ray.ray.org_y = at[1], ray.ray.org_z = at[2];
  ray.ray.dir_x = float(direction[0]), ray.ray.dir_y = float(direction[1]),
  ray.ray.dir_z = float(direction[2]);
  ray.ray.tnear = float(least), ray.ray.tfar = float(most);
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->handle(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const float along =
      ray.hit.Ng_x * ray.ray.dir_x + ray.hit.Ng_y * ray.ray.dir_y + ray.hit.Ng_z * ray.ray.dir_z;
  return Hit{double(ray.ray.tfar), along > 0, ray.hit.primID};
}

}  // namespace kreisel::core
