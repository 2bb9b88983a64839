#include "mesh/solid/self_intersections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "geometry/box_pairs.hpp"
#include "geometry/predicates.hpp"
#include "geometry/triangle.hpp"
#include "geometry/triangle_pair.hpp"
#include "mesh/query/equal_vertices.hpp"
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

/// Boxes around the triangles with area, rounded outward. They are taken about the middle of the mesh and in
/// units of its size: rounded, but monotonically, so what overlaps goes on overlapping.
std::vector<NumberedBox> boxes_of(const TriangleMesh& mesh) {
  const Box all = bounding_box(mesh);
  const Vec3 centre = all.centre();
  const double size = all.extent().maxCoeff(), scale = size > 0 ? 1 / size : 1;
  const auto local = [&](const Vec3& p) -> Vec3 { return (p - centre) * scale; };
  std::vector<NumberedBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    stop_here(t);
    const auto [p, q, r] = corners_of(mesh, mesh.triangles[t]);
    if (projection_axis(p, q, r) < 0) continue;
    boxes.push_back({below(local(p.cwiseMin(q).cwiseMin(r))), above(local(p.cwiseMax(q).cwiseMax(r))), t});
  }
  return boxes;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> self_intersections(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  // Vertices at one place have one number.
  const std::vector<std::uint32_t> number = first_equal_vertex(mesh.vertices);
  const auto numbered = [&](std::uint32_t t) -> NumberedTriangle {
    const auto& [a, b, c] = mesh.triangles[t];
    return {{number[a], number[b], number[c]}, corners_of(mesh, mesh.triangles[t])};
  };
  std::vector<std::array<std::uint32_t, 2>> pairs;
  std::mutex finding;
  for_each_overlap(boxes_of(mesh), [&](std::uint32_t low, std::uint32_t high) {
    if (!intersect_improperly(numbered(low), numbered(high))) return;
    const std::scoped_lock lock(finding);
    pairs.push_back({low, high});
  });
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace kreisel::core
