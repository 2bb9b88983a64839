#include "mesh/solid/self_intersections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "geometry/predicates.hpp"
#include "geometry/triangle_pair.hpp"
#include "mesh/query/embree_scene.hpp"
#include "mesh/query/equal_vertices.hpp"

namespace kreisel::core {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Eigen::Vector3f below(const Vec3& p) {
  return p.cast<float>().unaryExpr([](float x) { return std::nextafter(x, -infinity); });
}
Eigen::Vector3f above(const Vec3& p) {
  return p.cast<float>().unaryExpr([](float x) { return std::nextafter(x, infinity); });
}

struct Search {
  Vec3 centre;   ///< boxes are taken about it, in units of
  double scale;  ///< the size: rounded, but monotonically, so what overlaps goes on overlapping
  std::vector<NumberedTriangle> triangles;  ///< those with area
  std::vector<std::uint32_t> index;         ///< of each in the mesh
  std::mutex mutex;                         ///< for pairs: judge() may be called by several threads at once
  std::vector<std::array<std::uint32_t, 2>> pairs;
};

void set_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& search = *static_cast<const Search*>(arguments->geometryUserPtr);
  const auto& c = search.triangles[arguments->primID].corner;
  const auto local = [&](const Vec3& p) -> Vec3 { return (p - search.centre) * search.scale; };
  const Eigen::Vector3f lo = below(local(c[0].cwiseMin(c[1]).cwiseMin(c[2])));
  const Eigen::Vector3f hi = above(local(c[0].cwiseMax(c[1]).cwiseMax(c[2])));
  RTCBounds& b = *arguments->bounds_o;
  b.lower_x = lo.x(), b.lower_y = lo.y(), b.lower_z = lo.z();
  b.upper_x = hi.x(), b.upper_y = hi.y(), b.upper_z = hi.z();
}

/// Embree gives candidates in batches, a pair of primitives perhaps in either order.
void judge(void* user, RTCCollision* candidates, unsigned count) {
  auto& search = *static_cast<Search*>(user);
  for (const RTCCollision* c = candidates; c != candidates + count; ++c) {
    if (c->primID0 == c->primID1) continue;
    const auto [low, high] = std::minmax(c->primID0, c->primID1);
    if (!intersect_improperly(search.triangles[low], search.triangles[high])) continue;
    const std::lock_guard lock(search.mutex);
    search.pairs.push_back({search.index[low], search.index[high]});
  }
}

void number(const TriangleMesh& mesh, Search& search) {
  const Box box = bounding_box(mesh);
  search.centre = box.centre();
  const double size = box.extent().maxCoeff();
  search.scale = size > 0 ? 1 / size : 1;
  const std::vector<std::uint32_t> first = first_equal_vertex(mesh.vertices);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    if (projection_axis(p, q, r) < 0) continue;
    search.triangles.push_back({{first[a], first[b], first[c]}, {p, q, r}});
    search.index.push_back(std::uint32_t(i));
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> self_intersections(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  Search search;
  number(mesh, search);
  if (search.triangles.empty()) return {};
  EmbreeScene scene;
  const RTCGeometry geometry = rtcNewGeometry(scene.device(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, unsigned(search.triangles.size()));
  rtcSetGeometryUserData(geometry, &search);
  rtcSetGeometryBoundsFunction(geometry, set_bounds, nullptr);
  rtcCommitGeometry(geometry);
  scene.commit(geometry);
  rtcCollide(scene.handle(), scene.handle(), judge, &search);

  std::sort(search.pairs.begin(), search.pairs.end());
  search.pairs.erase(std::unique(search.pairs.begin(), search.pairs.end()), search.pairs.end());
  return search.pairs;
}

}  // namespace kreisel::core
