#include "mesh/solid/self_intersections.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>

#include "geometry/predicates.hpp"
#include "geometry/triangle.hpp"
#include "geometry/triangle_pair.hpp"
#include "mesh/query/embree_scene.hpp"
#include "mesh/query/equal_vertices.hpp"
#include "parallel.hpp"
#include "stop.hpp"

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
  explicit Search(const TriangleMesh& of) : mesh(of) {}

  const TriangleMesh& mesh;
  Vec3 centre = Vec3::Zero();  ///< boxes are taken about it, in units of
  double scale = 1;            ///< the size: rounded, but monotonically, so what overlaps goes on overlapping
  std::vector<std::uint32_t> number;  ///< of each vertex: those at one place have one
  std::vector<std::uint32_t> index;   ///< of the triangles with area
  std::vector<RTCCollision> candidates;
  std::mutex mutex;  ///< for what follows
  std::vector<std::array<std::uint32_t, 2>> pairs;
  std::exception_ptr failure = nullptr;  ///< no exception may pass through Embree

  [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t primitive) const {
    return corners_of(mesh, mesh.triangles[index[primitive]]);
  }
  [[nodiscard]] NumberedTriangle numbered(std::uint32_t primitive) const {
    const auto& [a, b, c] = mesh.triangles[index[primitive]];
    return {{number[a], number[b], number[c]}, corners(primitive)};
  }
};

void set_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& search = *static_cast<const Search*>(arguments->geometryUserPtr);
  const auto c = search.corners(arguments->primID);
  const auto local = [&](const Vec3& p) -> Vec3 { return (p - search.centre) * search.scale; };
  const Eigen::Vector3f lo = below(local(c[0].cwiseMin(c[1]).cwiseMin(c[2])));
  const Eigen::Vector3f hi = above(local(c[0].cwiseMax(c[1]).cwiseMax(c[2])));
  RTCBounds& b = *arguments->bounds_o;
  b.lower_x = lo.x(), b.lower_y = lo.y(), b.lower_z = lo.z();
  b.upper_x = hi.x(), b.upper_y = hi.y(), b.upper_z = hi.z();
}

/// Decides about the candidates so far, by all threads.
void judge(Search& search) {
  constexpr std::size_t block = 4096;
  parallel_for((search.candidates.size() + block - 1) / block, [&](std::size_t b) {
    const auto end = std::min((b + 1) * block, search.candidates.size());
    for (std::size_t i = b * block; i < end; ++i) {
      const auto [low, high] = std::minmax(search.candidates[i].primID0, search.candidates[i].primID1);
      if (!intersect_improperly(search.numbered(low), search.numbered(high))) continue;
      const std::lock_guard lock(search.mutex);
      search.pairs.push_back({search.index[low], search.index[high]});
    }
  });
  search.candidates.clear();
}

/// Embree gives candidates in batches, a pair of primitives perhaps in either order.
void gather(void* user, RTCCollision* candidates, unsigned count) {
  constexpr std::size_t most = std::size_t{1} << 20;
  auto& search = *static_cast<Search*>(user);
  if (search.failure) return;
  try {
    stop_here();
    for (const RTCCollision* c = candidates; c != candidates + count; ++c)
      if (c->primID0 != c->primID1) search.candidates.push_back(*c);
    if (search.candidates.size() >= most) judge(search);
  } catch (...) {
    search.failure = std::current_exception();
  }
}

void number(Search& search) {
  const TriangleMesh& mesh = search.mesh;
  const Box box = bounding_box(mesh);
  search.centre = box.centre();
  const double size = box.extent().maxCoeff();
  search.scale = size > 0 ? 1 / size : 1;
  search.number = first_equal_vertex(mesh.vertices);
  search.index.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [p, q, r] = corners_of(mesh, mesh.triangles[i]);
    if (projection_axis(p, q, r) >= 0) search.index.push_back(std::uint32_t(i));
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> self_intersections(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  Search search(mesh);
  number(search);
  if (search.index.empty()) return {};
  EmbreeScene scene;
  const RTCGeometry geometry = rtcNewGeometry(scene.device(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, unsigned(search.index.size()));
  rtcSetGeometryUserData(geometry, &search);
  rtcSetGeometryBoundsFunction(geometry, set_bounds, nullptr);
  rtcCommitGeometry(geometry);
  scene.commit(geometry);
  rtcCollide(scene.handle(), scene.handle(), gather, &search);
  if (search.failure) std::rethrow_exception(search.failure);
  judge(search);

  std::sort(search.pairs.begin(), search.pairs.end());
  search.pairs.erase(std::unique(search.pairs.begin(), search.pairs.end()), search.pairs.end());
  return search.pairs;
}

}  // namespace kreisel::core
