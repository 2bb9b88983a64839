// crossings_by_force.hpp - every edge of a mesh against every triangle near it.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Edges that pass through the inside of a triangle they share no corner with. Two surfaces that cross do so
/// along a curve, and where that enters or leaves a triangle an edge is pierced, so 0 means no crossing
/// (touching apart). Plain floating point, for small meshes in general position.
inline int crossing_edges(const TriangleMesh& mesh) {
  const auto& v = mesh.vertices;
  std::set<std::array<std::uint32_t, 2>> edges;
  double longest = 0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      edges.insert({std::min(a, b), std::max(a, b)});
      longest = std::max(longest, (v[a] - v[b]).norm());
    }
  // Triangles by the cube their first corner is in: within two longest edges of each other or apart.
  const auto cube = [&](const Vec3& p) {
    return std::array<int, 3>{int(std::floor(p[0] / (2 * longest))), int(std::floor(p[1] / (2 * longest))),
                              int(std::floor(p[2] / (2 * longest)))};
  };
  std::map<std::array<int, 3>, std::vector<const Triangle*>> cubes;
  for (const Triangle& t : mesh.triangles) cubes[cube(v[t[0]])].push_back(&t);

  int crossing = 0;
  const auto pierces = [&](std::uint32_t e0, std::uint32_t e1, const Triangle& t) {
    for (const std::uint32_t c : t)
      if (c == e0 || c == e1) return false;
    const auto side = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
      return (b - a).cross(c - a).dot(d - a) > 0;
    };
    const Vec3 &p = v[e0], &q = v[e1], &a = v[t[0]], &b = v[t[1]], &c = v[t[2]];
    if (side(a, b, c, p) == side(a, b, c, q)) return false;
    const bool s = side(p, q, a, b);
    return s == side(p, q, b, c) && s == side(p, q, c, a);
  };
  for (const auto& [e0, e1] : edges) {
    const std::array<int, 3> at = cube(v[e0]);
    for (int n = 0; n < 27; ++n) {
      const auto found = cubes.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
      if (found == cubes.end()) continue;
      for (const Triangle* t : found->second) crossing += pierces(e0, e1, *t);
    }
  }
  return crossing;
}

}  // namespace kreisel::core
