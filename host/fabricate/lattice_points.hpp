// lattice_points.hpp - which points of a lattice are deep inside a solid.
#pragma once

#include <algorithm>
#include <cmath>

#include "domain/exact.hpp"
#include "mesh/make/march.hpp"

namespace kreisel::core {

/// Calls visit(CubicLattice::Index) for every point of the lattice that is inside the mesh and at least
/// `depth` from its surface, by the exact offset along the lattice's vertical lines.
/// @param depth  0: all that are inside
/// @throws InputError  a mesh that is not closed
template <class Visit>
void for_each_inside(const TriangleMesh& mesh, double depth, const CubicLattice& lattice,
                     const Visit& visit) {
  using Index = CubicLattice::Index;
  for (const int parity : {0, 1}) {  // corners, centres
    const Index first = Index::Constant(parity), n = (lattice.n() - first + Index::Ones()) / 2;
    Grid grid;
    grid.h = lattice.cell();
    grid.n = {n[0], n[1], n[2]};
    grid.origin = lattice.point(first) - Vec3::Constant(grid.h / 2);
    for (const ExactInterval& run : SolidLines(mesh, grid).intervals(depth)) {
      const auto at = [&](double z) { return (z - lattice.point(first)[2]) / grid.h; };
      const int k0 = std::max(0, static_cast<int>(std::ceil(at(run.z0)))),
                k1 = std::min(n[2] - 1, static_cast<int>(std::floor(at(run.z1))));
      for (int k = k0; k <= k1; ++k) visit(first + 2 * Index(run.ix, run.iy, k));
    }
  }
}

}  // namespace kreisel::core
