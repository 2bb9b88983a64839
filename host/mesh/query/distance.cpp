#include "mesh/query/distance.hpp"

#include <algorithm>
#include <limits>

#include "geometry/distance.hpp"
#include "mesh/query/embree_scene.hpp"

namespace kreisel::core {

struct SurfaceDistance::Scene {
  explicit Scene(const TriangleMesh& of) : mesh(&of), embree(of) {
    for (const Vec3& v : of.vertices) largest = std::max(largest, embree.local(v).cwiseAbs().maxCoeff());
  }
  /// Covers the rounding of the mesh and the query point to single precision.
  [[nodiscard]] float margin(const Eigen::Vector3f& at) const {
    return 16 * std::max(largest, at.cwiseAbs().maxCoeff()) * std::numeric_limits<float>::epsilon();
  }

  const TriangleMesh* mesh;
  EmbreeScene embree;
  float largest = 0;  ///< coordinate of the mesh as Embree has it
};

struct SurfaceDistance::Query {
  const TriangleMesh* mesh;
  Vec3 point;
  double best, enough;
  float margin = 0;
  std::optional<std::uint32_t> nearest = {};

  static bool visit(RTCPointQueryFunctionArguments* arguments) {
    auto& query = *static_cast<Query*>(arguments->userPtr);
    const Triangle& t = query.mesh->triangles[arguments->primID];
    const auto& v = query.mesh->vertices;
    const double d = distance_to_triangle(query.point, v[t[0]], v[t[1]], v[t[2]]);
    if (d >= query.best) return false;
    query.best = d;
    query.nearest = arguments->primID;
    arguments->query->radius = d < query.enough ? 0.0f : static_cast<float>(d) + query.margin;
    return true;  // the radius shrank
  }
};

SurfaceDistance::SurfaceDistance(const TriangleMesh& mesh) : scene_(std::make_unique<Scene>(mesh)) {}

SurfaceDistance::~SurfaceDistance() = default;

void SurfaceDistance::search(Query& query, double limit) const {
  const Eigen::Vector3f at = scene_->embree.local(query.point);
  query.margin = scene_->margin(at);
  RTCPointQuery embree{};
  embree.x = at[0], embree.y = at[1], embree.z = at[2];
  embree.radius = static_cast<float>(limit) + query.margin;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_->embree.handle(), &embree, &context, Query::visit, &query);
}

double SurfaceDistance::operator()(const Vec3& point, double limit, double enough) const {
  Query query{scene_->mesh, point, limit, enough};
  search(query, limit);
  return query.best;
}

std::optional<std::uint32_t> SurfaceDistance::nearest(const Vec3& point, double limit) const {
  Query query{scene_->mesh, point, limit, 0};
  search(query, limit);
  return query.nearest;
}

}  // namespace kreisel::core
