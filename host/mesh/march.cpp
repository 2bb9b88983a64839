#include "mesh/march.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "parallel.hpp"

namespace kreisel {
namespace {

using Index = CubicLattice::Index;

/// Cuts tetrahedra; their pieces share the vertices on common edges.
class Cutter {
 public:
  struct Edge {
    Index in, out;
  };
  /// Around a piece of surface; the last two are the same in a triangle.
  using Piece = std::array<std::uint32_t, 4>;

  Cutter(const CubicLattice& lattice, const std::vector<std::uint8_t>& inside)
      : lattice_(lattice), inside_(inside) {}

  [[nodiscard]] bool inside(const Index& at) const { return inside_[lattice_.id(at)] != 0; }

  /// @param corners  with (1-0) . ((2-0) x (3-0)) > 0
  void cut(const std::array<Index, 4>& corners) {
    unsigned in = 0;
    for (unsigned i = 0; i < 4; ++i) in |= unsigned(inside(corners[i])) << i;
    const auto on = [&](int a, int b) { return vertex(corners[std::size_t(a)], corners[std::size_t(b)]); };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      pieces.push_back({a, b, c, d});
    };
    for (int i = 0; i < 4; ++i) {
      const int b = i ^ 1, c = i ^ 2, d = i ^ 3;  // (i, b, c, d) is an even permutation
      if (in == 1u << i) add(on(i, b), on(i, c), on(i, d), on(i, d));
      if (in == (15u ^ 1u << i)) add(on(i, b), on(i, d), on(i, c), on(i, c));
    }
    for (const auto& [a, b, c, d] : even_pairs)
      if (in == (1u << a | 1u << b)) add(on(a, c), on(a, d), on(b, d), on(b, c));
  }

  std::vector<Edge> edges;  ///< one a vertex
  std::vector<Piece> pieces;

 private:
  static constexpr int even_pairs[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                           {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};

  std::uint32_t vertex(const Index& p, const Index& q) {
    const std::uint64_t lo = std::min(lattice_.id(p), lattice_.id(q));
    const std::uint64_t hi = std::max(lattice_.id(p), lattice_.id(q));
    const auto [entry, fresh] = on_edge_.try_emplace(lo << 32 | hi, std::uint32_t(edges.size()));
    if (fresh) edges.push_back(inside(p) ? Edge{p, q} : Edge{q, p});
    return entry->second;
  }

  const CubicLattice& lattice_;
  const std::vector<std::uint8_t>& inside_;
  std::unordered_map<std::uint64_t, std::uint32_t> on_edge_;
};

/// Four tetrahedra stand around every edge from one cube centre to the next.
void cut_all(const CubicLattice& lattice, Cutter& cutter) {
  const Index& n = lattice.n();
  for (int k = 1; k < n.z(); k += 2)
    for (int j = 1; j < n.y(); j += 2)
      for (int i = 1; i < n.x(); i += 2)
        for (int a = 0; a < 3; ++a) {
          const Index here(i, j, k), next = here + 2 * Index::Unit(a);
          if (next[a] >= n[a]) continue;
          const Index u = Index::Unit((a + 1) % 3), v = Index::Unit((a + 2) % 3),
                      middle = here + Index::Unit(a);
          const std::array<Index, 4> ring = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
          int in = cutter.inside(here) + cutter.inside(next);
          for (const Index& corner : ring) in += cutter.inside(corner);
          if (in == 0 || in == 6) continue;
          for (std::size_t r = 0; r < 4; ++r) cutter.cut({here, next, ring[r], ring[(r + 1) % 4]});
        }
}

}  // namespace

CubicLattice::CubicLattice(const Box& box, double cell) : half_(cell / 2) {
  const Vec3 middle = (box.lo + box.hi) / 2;
  for (int a = 0; a < 3; ++a) n_[a] = 2 * (int(std::ceil(box.extent()[a] / cell)) + 2) + 1;
  origin_ = middle - half_ / 2 * (n_ - Index::Ones()).cast<double>();
}

TriangleMesh march(const CubicLattice& lattice, const std::vector<std::uint8_t>& inside,
                   const PlaceOnEdge& place) {
  Cutter cutter(lattice, inside);
  cut_all(lattice, cutter);

  TriangleMesh mesh;
  mesh.vertices.resize(cutter.edges.size());
  constexpr std::size_t chunk = 512;
  parallel_for((mesh.vertices.size() + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, mesh.vertices.size()); ++i)
      mesh.vertices[i] = place(cutter.edges[i].in, cutter.edges[i].out);
  });

  const auto& v = mesh.vertices;
  for (const auto& [a, b, c, d] : cutter.pieces) {
    if (c == d) {
      mesh.triangles.push_back({a, b, c});
    } else if ((v[a] - v[c]).squaredNorm() > (v[b] - v[d]).squaredNorm()) {
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({b, c, d});
    } else {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace kreisel
