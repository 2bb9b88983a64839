#include "mesh/make/march.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "mesh/make/crease.hpp"
#include "parallel.hpp"
#include "stop.hpp"

namespace kreisel::core {
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

/// An edge from one cube centre to the next, around which four tetrahedra stand.
struct Spoke {
  Index from;
  int axis;
};

/// The corners around a spoke, counter-clockwise seen from its end.
std::array<Index, 4> ring_of(const Spoke& spoke) {
  const Index u = Index::Unit((spoke.axis + 1) % 3), v = Index::Unit((spoke.axis + 2) % 3),
              middle = spoke.from + Index::Unit(spoke.axis);
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

/// Those of a layer of centres whose tetrahedra are neither all inside nor all outside. Most are one or the
/// other, so this is all that is done for every place of the lattice: bytes at fixed distances from each
/// other are added up.
std::vector<Spoke> crossed(const CubicLattice& lattice, const std::vector<std::uint8_t>& inside, int k) {
  const Index& n = lattice.n();
  std::array<std::array<std::ptrdiff_t, 5>, 3> steps;
  const Index first(1, 1, 1);
  const auto step = [&](const Index& to) {
    return static_cast<std::ptrdiff_t>(lattice.id(to)) - static_cast<std::ptrdiff_t>(lattice.id(first));
  };
  for (int a = 0; a < 3; ++a) {
    const auto ring = ring_of({first, a});
    steps[static_cast<std::size_t>(a)] = {step(first + 2 * Index::Unit(a)), step(ring[0]), step(ring[1]),
                                          step(ring[2]), step(ring[3])};
  }
  std::vector<Spoke> found;
  for (int j = 1; j < n.y(); j += 2)
    for (int i = 1; i < n.x(); i += 2) {
      const Index here(i, j, k);
      const std::uint8_t* at = inside.data() + lattice.id(here);
      for (int a = 0; a < 3; ++a) {
        if (here[a] + 2 >= n[a]) continue;
        int in = *at;
        for (const std::ptrdiff_t to : steps[static_cast<std::size_t>(a)]) in += at[to];
        if (in != 0 && in != 6) found.push_back({here, a});
      }
    }
  return found;
}

void cut_all(const CubicLattice& lattice, const std::vector<std::uint8_t>& inside, Cutter& cutter) {
  std::vector<std::vector<Spoke>> layers(static_cast<std::size_t>(lattice.n().z() / 2));
  parallel_for(layers.size(),
               [&](std::size_t l) { layers[l] = crossed(lattice, inside, 2 * static_cast<int>(l) + 1); });
  for (const std::vector<Spoke>& layer : layers)
    for (const Spoke& spoke : layer) {
      stop_here();
      const auto ring = ring_of(spoke);
      for (std::size_t r = 0; r < 4; ++r)
        cutter.cut({spoke.from, spoke.from + 2 * Index::Unit(spoke.axis), ring[r], ring[(r + 1) % 4]});
    }
}

}  // namespace

CubicLattice::CubicLattice(const Box& box, double cell) : half_(cell / 2) {
  for (int a = 0; a < 3; ++a) n_[a] = 2 * (int(std::ceil(box.extent()[a] / cell)) + 2) + 1;
  origin_ = box.centre() - half_ / 2 * (n_ - Index::Ones()).cast<double>();
}

TriangleMesh march(const CubicLattice& lattice, const std::vector<std::uint8_t>& inside,
                   const PlaceOnEdge& place) {
  return march(lattice, inside,
               {[&](const Index& in, const Index& out) {
                  return TwoPieces::Point{place(in, out), false};
                },
                {}});
}

TriangleMesh march(const CubicLattice& lattice, const std::vector<std::uint8_t>& inside,
                   const TwoPieces& surface) {
  Cutter cutter(lattice, inside);
  cut_all(lattice, inside, cutter);

  TriangleMesh mesh;
  std::vector<std::uint8_t> second(cutter.edges.size());
  mesh.vertices.resize(cutter.edges.size());
  parallel_for(mesh.vertices.size(), 512, [&](std::size_t i) {
    const TwoPieces::Point point = surface.place(cutter.edges[i].in, cutter.edges[i].out);
    mesh.vertices[i] = point.at;
    second[i] = point.second;
  });

  const auto& v = mesh.vertices;
  std::vector<CreasedLoop> creased;
  for (const auto& [a, b, c, d] : cutter.pieces) {
    if (second[a] != second[b] || second[a] != second[c] || second[a] != second[d]) {
      creased.push_back(c == d ? CreasedLoop{a, b, c} : CreasedLoop{a, b, c, d});
    } else if (c == d) {
      mesh.triangles.push_back({a, b, c});
    } else if ((v[a] - v[c]).squaredNorm() > (v[b] - v[d]).squaredNorm()) {
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({b, c, d});
    } else {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  if (creased.empty()) return mesh;
  // Of the face that two points of its edges lie in, the corners.
  const auto face_of = [&](std::uint32_t i, std::uint32_t j) {
    const Cutter::Edge &e = cutter.edges[i], &f = cutter.edges[j];
    const Index& third = f.in == e.in || f.in == e.out ? f.out : f.in;
    return std::array<Vec3, 3>{lattice.point(e.in), lattice.point(e.out), lattice.point(third)};
  };
  add_creased(mesh, creased, second, face_of, surface.meet);
  return mesh;
}

}  // namespace kreisel::core
