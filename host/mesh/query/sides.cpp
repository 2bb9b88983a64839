#include "mesh/query/sides.hpp"

namespace kreisel::core {

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  // A counting sort by the lower end leaves only the few sides of each vertex to be compared.
  std::vector<std::size_t> start(mesh.vertices.size() + 1, 0);
  const auto each = [&](auto&& visit) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (std::uint8_t k = 0; k < 3; ++k) {
        const std::uint32_t from = mesh.triangles[i][k], to = mesh.triangles[i][(k + 1u) % 3];
        if (from != to) visit(Side{std::min(from, to), std::max(from, to), std::uint32_t(i), k, from < to});
      }
  };
  each([&](const Side& s) { ++start[s.low + 1]; });
  for (std::size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
  std::vector<Side> sides(start.back());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  each([&](const Side& s) { sides[next[s.low]++] = s; });
  for (std::size_t v = 0; v + 1 < start.size(); ++v)
    std::sort(sides.begin() + std::ptrdiff_t(start[v]), sides.begin() + std::ptrdiff_t(start[v + 1]),
              [](const Side& a, const Side& b) {
                return a.high != b.high ? a.high < b.high
                                        : 3 * a.triangle + a.corner < 3 * b.triangle + b.corner;
              });
  return sides;
}

DisjointSets corner_fans(const TriangleMesh& mesh, const std::vector<Side>& sides) {
  DisjointSets fans(3 * mesh.triangles.size());
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first != 2) return;
    for (const bool at_low : {true, false}) fans.join(first[0].corner_at(at_low), first[1].corner_at(at_low));
  });
  return fans;
}

}  // namespace kreisel::core
