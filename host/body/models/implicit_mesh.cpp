#include "body/models/implicit_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace kreisel {
namespace {

using Index3 = Eigen::Vector3i;

/// Cube corners have even coordinates, cube centres odd ones; both hold a value. One unit is half a cell.
class Lattice {
 public:
  Lattice(const Field& field, const Box& box, double cell) : half_(cell / 2) {
    // Centred, so that a symmetric solid gets a symmetric lattice; a cube of margin on every side.
    const Vec3 middle = (box.lo + box.hi) / 2;
    for (int a = 0; a < 3; ++a) n_[a] = 2 * (int(std::ceil(box.extent()[a] / cell)) + 2) + 1;
    origin_ = middle - half_ / 2 * (n_ - Index3::Ones()).cast<double>();
    values_.resize(std::size_t(n_.x() / 2 + 1) * (n_.y() / 2 + 1) * n_.z());
    for (int k = 0; k < n_.z(); ++k)
      for (int j = k % 2; j < n_.y(); j += 2)
        for (int i = k % 2; i < n_.x(); i += 2) {
          const Index3 at(i, j, k);
          values_[id(at)] = field(point(at));
          const bool rim = (at.array() <= 1).any() || (at.array() >= n_.array() - 2).any();
          if (rim && values_[id(at)] < 0)
            throw std::logic_error("mesh_of: the solid does not fit into its box");
        }
  }

  [[nodiscard]] const Index3& n() const { return n_; }
  /// In a layer all x and y have the parity of z, so halving them leaves no two points on one place.
  [[nodiscard]] std::size_t id(const Index3& at) const {
    return (std::size_t(at.z()) * (n_.y() / 2 + 1) + at.y() / 2) * (n_.x() / 2 + 1) + at.x() / 2;
  }
  [[nodiscard]] Vec3 point(const Index3& at) const { return origin_ + half_ * at.cast<double>(); }
  [[nodiscard]] double value(const Index3& at) const { return values_[id(at)]; }

 private:
  double half_;
  Vec3 origin_;
  Index3 n_;
  std::vector<double> values_;
};

/// Cuts tetrahedra and joins their pieces along common edges.
class Cutter {
 public:
  explicit Cutter(const Lattice& lattice) : lattice_(lattice) {}

  /// @param corners  with (1-0) . ((2-0) x (3-0)) > 0
  void cut(const std::array<Index3, 4>& corners) {
    unsigned inside = 0;
    for (unsigned i = 0; i < 4; ++i) inside |= unsigned(lattice_.value(corners[i]) < 0) << i;
    const auto on = [&](int a, int b) { return vertex(corners[std::size_t(a)], corners[std::size_t(b)]); };
    for (int i = 0; i < 4; ++i) {
      const int b = i ^ 1, c = i ^ 2, d = i ^ 3;  // (i, b, c, d) is an even permutation
      if (inside == 1u << i) add(on(i, b), on(i, c), on(i, d));
      if (inside == (15u ^ 1u << i)) add(on(i, b), on(i, d), on(i, c));
    }
    for (const auto& [a, b, c, d] : even_pairs)
      if (inside == (1u << a | 1u << b)) add_quad(on(a, c), on(a, d), on(b, d), on(b, c));
  }

  TriangleMesh mesh;

 private:
  static constexpr int even_pairs[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                           {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh.triangles.push_back({a, b, c}); }

  void add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const auto& v = mesh.vertices;
    if ((v[a] - v[c]).squaredNorm() > (v[b] - v[d]).squaredNorm()) {
      add(a, b, d);
      add(b, c, d);
    } else {
      add(a, b, c);
      add(a, c, d);
    }
  }

  /// Where the edge crosses zero, by the secant; made once, for whichever tetrahedron asks first.
  std::uint32_t vertex(const Index3& p, const Index3& q) {
    const std::uint64_t lo = std::min(lattice_.id(p), lattice_.id(q));
    const std::uint64_t hi = std::max(lattice_.id(p), lattice_.id(q));
    const auto [entry, fresh] = on_edge_.try_emplace(lo << 32 | hi, std::uint32_t(mesh.vertices.size()));
    if (fresh) {
      const double fp = lattice_.value(p), fq = lattice_.value(q);
      const double t = std::clamp(fp / (fp - fq), 0.05, 0.95);  // a start for what comes after
      mesh.vertices.push_back((1 - t) * lattice_.point(p) + t * lattice_.point(q));
    }
    return entry->second;
  }

  const Lattice& lattice_;
  std::unordered_map<std::uint64_t, std::uint32_t> on_edge_;
};

/// Four tetrahedra stand around every edge from one cube centre to the next.
TriangleMesh march(const Lattice& lattice) {
  Cutter cutter(lattice);
  const Index3& n = lattice.n();
  for (int k = 1; k < n.z(); k += 2)
    for (int j = 1; j < n.y(); j += 2)
      for (int i = 1; i < n.x(); i += 2)
        for (int a = 0; a < 3; ++a) {
          const Index3 here(i, j, k), next = here + 2 * Index3::Unit(a);
          if (next[a] >= n[a]) continue;
          const Index3 u = Index3::Unit((a + 1) % 3), v = Index3::Unit((a + 2) % 3),
                       middle = here + Index3::Unit(a);
          const std::array<Index3, 4> ring = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
          for (std::size_t r = 0; r < 4; ++r) cutter.cut({here, next, ring[r], ring[(r + 1) % 4]});
        }
  return std::move(cutter.mesh);
}

/// Moves a point onto field = 0 by Newton's method along the gradient, no step longer than `most`.
void settle(const Field& field, Vec3& p, int steps, double difference, double most) {
  for (int s = 0; s < steps; ++s) {
    const double value = field(p);
    Vec3 gradient;  // forward differences: off by 1e-6 or so, which costs the steps little
    for (int a = 0; a < 3; ++a) gradient[a] = (field(p + difference * Vec3::Unit(a)) - value) / difference;
    const double square = gradient.squaredNorm();
    if (!(square > 0)) return;
    const Vec3 step = -value / square * gradient;
    const double length = step.norm();
    p += length > most ? Vec3(most / length * step) : step;
    if (length < 1e-7 * difference) return;
  }
}

/// Moves every vertex half way to the mean of its neighbours, along the surface only.
void even_out(TriangleMesh& mesh) {
  std::vector<Vec3> sum(mesh.vertices.size(), Vec3::Zero()), normal = sum;
  std::vector<int> count(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 twice_area = (b - a).cross(c - a);
    for (std::size_t k = 0; k < 3; ++k) {
      normal[t[k]] += twice_area;
      sum[t[k]] += mesh.vertices[t[(k + 1) % 3]];  // every neighbour once: the triangles around close up
      ++count[t[k]];
    }
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 n = normal[i].stableNormalized(), pull = 0.5 * (sum[i] / count[i] - mesh.vertices[i]);
    mesh.vertices[i] += pull - pull.dot(n) * n;
  }
}

}  // namespace

TriangleMesh mesh_of(const Field& field, const Box& box, double cell) {
  TriangleMesh mesh = march(Lattice(field, box, cell));
  const double difference = 1e-6 * box.extent().maxCoeff();
  const auto settle_all = [&](int steps) {
    for (Vec3& v : mesh.vertices) settle(field, v, steps, difference, cell / 2);
  };
  settle_all(2);
  for (int round = 0; round < 8; ++round) {
    even_out(mesh);
    settle_all(1);
  }
  settle_all(6);
  return mesh;
}

}  // namespace kreisel
