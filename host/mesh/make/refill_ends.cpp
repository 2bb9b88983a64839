#include "mesh/make/refill_ends.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "geometry/fill_polygon.hpp"

namespace kreisel::core {
namespace {

/// Of each corner on the outline of some triangles the next one; nothing where outlines meet, or miss a
/// corner.
std::optional<std::map<std::uint32_t, std::uint32_t>> outline(const std::vector<Triangle>& triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> open;
  std::set<std::uint32_t> corners;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      corners.insert(a);
      if (open.erase({b, a}) == 0) open.insert({a, b});
    }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [a, b] : open)
    if (!next.emplace(a, b).second) return {};
  if (next.size() != corners.size()) return {};
  return next;
}

}  // namespace

void refill_ends(TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  for (const bool top : {false, true}) {
    const double height = top ? box.hi[2] : box.lo[2];
    const auto flat = std::partition(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return std::ranges::any_of(t, [&](std::uint32_t c) { return mesh.vertices[c][2] != height; });
    });
    auto next = outline({flat, mesh.triangles.end()});
    if (flat == mesh.triangles.end() || !next) continue;
    Polygon points;  // seen from outside
    for (const Vec3& p : mesh.vertices) points.push_back(top ? Vec2(p[0], p[1]) : Vec2(p[1], p[0]));
    const std::vector<Triangle> filled = fill_loops(points, loops_along(std::move(*next)));
    mesh.triangles.erase(flat, mesh.triangles.end());
    mesh.triangles.insert(mesh.triangles.end(), filled.begin(), filled.end());
  }
}

}  // namespace kreisel::core
