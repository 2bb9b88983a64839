#include "body/models/implicit_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/triangle.hpp"
#include "mesh/make/march.hpp"

namespace kreisel::core {
namespace {

/// The surface between the lattice points where the field is negative and the others, by the secant.
TriangleMesh marched(const ScalarField& field, const Box& box, double cell) {
  const CubicLattice lattice(box, cell);
  std::vector<double> values(lattice.size());
  std::vector<std::uint8_t> inside(lattice.size());
  lattice.for_each([&](const CubicLattice::Index& at) {
    const std::size_t id = lattice.id(at);
    values[id] = field(lattice.point(at));
    inside[id] = values[id] < 0;
    if (inside[id] && lattice.rim(at)) throw std::logic_error("mesh_of: the solid does not fit into its box");
  });
  return march(lattice, inside, [&](const CubicLattice::Index& in, const CubicLattice::Index& out) -> Vec3 {
    const double fp = values[lattice.id(in)], fq = values[lattice.id(out)];
    const double t = std::clamp(fp / (fp - fq), 0.05, 0.95);  // a start for what comes after
    return (1 - t) * lattice.point(in) + t * lattice.point(out);
  });
}

/// Moves a point onto field = 0 by Newton's method along the gradient, no step longer than `most`.
void settle(const ScalarField& field, Vec3& p, int steps, double difference, double most) {
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
    const Vec3 twice_area = normal_of(mesh, t);
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

TriangleMesh mesh_of(const ScalarField& field, const Box& box, double cell) {
  TriangleMesh mesh = marched(field, box, cell);
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

}  // namespace kreisel::core
