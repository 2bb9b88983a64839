#include "fabricate/high_places.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "geometry/triangle.hpp"
#include "mesh/query/sides.hpp"

namespace kreisel::core {
namespace {

/// Whether the solid is below a vertex: its triangles face upward, as a whole.
std::vector<bool> facing_up(const TriangleMesh& mesh) {
  std::vector<double> up(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    const double area = normal_of(mesh, t)[2];
    for (const std::uint32_t v : t) up[v] += area;
  }
  std::vector<bool> faces;
  for (const double area : up) faces.push_back(area > 0);
  return faces;
}

}  // namespace

/// The surface is flooded from the top: vertices one by one, the highest first, join what they touch. Where
/// two pieces meet, the lower hump ends.
std::vector<Vec3> high_places(const TriangleMesh& solid, double least) {
  const std::size_t n = solid.vertices.size();
  std::vector<std::uint32_t> order(n), rank(n);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const double za = solid.vertices[a][2], zb = solid.vertices[b][2];
    return za > zb || (za == zb && a < b);
  });
  for (std::uint32_t k = 0; k < n; ++k) rank[order[k]] = k;

  // Neighbours by rank: an edge counts for its lower end, once that is reached.
  std::vector<std::vector<std::uint32_t>> higher(n);
  for (const Triangle& t : solid.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = rank[t[k]], b = rank[t[(k + 1) % 3]];
      higher[std::max(a, b)].push_back(std::min(a, b));
    }

  const std::vector<bool> up = facing_up(solid);
  DisjointSets pieces(n);  // the lowest rank, which is the highest place, stands for each
  std::vector<std::uint32_t> found;
  const auto height = [&](std::uint32_t r) { return solid.vertices[order[r]][2]; };
  const auto end = [&](std::uint32_t top, std::optional<double> saddle) {
    if (up[order[top]] && (!saddle || height(top) - *saddle >= least)) found.push_back(top);
  };
  std::vector<bool> used(n);
  for (const Triangle& t : solid.triangles)
    for (const std::uint32_t v : t) used[rank[v]] = true;
  for (std::uint32_t r = 0; r < n; ++r)
    for (const std::uint32_t neighbour : higher[r]) {
      const std::uint32_t a = pieces.find(neighbour), b = pieces.find(r);
      if (a == b) continue;
      if (std::max(a, b) != r) end(std::max(a, b), height(r));
      pieces.join(a, b);
    }
  for (std::uint32_t r = 0; r < n; ++r)
    if (used[r] && pieces.find(r) == r) end(r, {});
  std::ranges::sort(found);
  std::vector<Vec3> places;
  for (const std::uint32_t r : found) places.push_back(solid.vertices[order[r]]);
  return places;
}

}  // namespace kreisel::core
