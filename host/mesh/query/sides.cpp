#include "mesh/query/sides.hpp"

#include <fmt/format.h>

#include <utility>

#include "error.hpp"
#include "parallel.hpp"
#include "stop.hpp"

namespace kreisel::core {

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  constexpr std::uint32_t most = std::uint32_t{1} << Side::triangle_bits;
  if (mesh.triangles.size() >= most)
    throw InputError(
        fmt::format("a mesh of {} triangles; expected fewer than {}", mesh.triangles.size(), most));
  // A counting sort by the lower end leaves only the few sides of each vertex to be compared.
  std::vector<std::uint32_t> start(mesh.vertices.size() + 2, 0);
  const auto each = [&](auto&& visit) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      stop_here(i);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t from = mesh.triangles[i][k], to = mesh.triangles[i][(k + 1) % 3];
        if (from != to)
          visit(Side{std::min(from, to), std::max(from, to), i & (most - 1), k & 3u, from < to});
      }
    }
  };
  each([&](const Side& s) { ++start[s.low + 2]; });
  for (std::size_t v = 2; v < start.size(); ++v) start[v] += start[v - 1];
  std::vector<Side> sides(start.back());
  each([&](const Side& s) { sides[start[s.low + 1]++] = s; });  // then start[v] is where those of v begin
  parallel_for(mesh.vertices.size(), 1 << 14, [&](std::size_t v) {
    std::sort(sides.begin() + start[v], sides.begin() + start[v + 1], [](const Side& a, const Side& b) {
      return a.high != b.high ? a.high < b.high
                              : std::pair(a.triangle, a.corner) < std::pair(b.triangle, b.corner);
    });
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
