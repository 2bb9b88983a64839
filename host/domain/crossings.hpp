// crossings.hpp - where the columns of a grid cross a closed mesh.
#pragma once

#include <vector>

#include "domain/grid.hpp"

namespace kreisel::core {

/// One crossing of a column's centre line with the surface.
struct Crossing {
  double z;
  int winding;  ///< +1 entering the solid upwards, -1 leaving it
};

/// Crossings of every column's centre line, sorted by z, indexed ix + nx * iy; windings of a column sum to
/// zero.
///
/// Triangles are scan-converted in double. A line through an edge or a corner meets exactly one of the
/// triangles there, as if it were moved by an infinitesimal (eps, eps^2) [Edelsbrunner and Muecke 1990,
/// Simulation of Simplicity]. A column that round-off leaves unbalanced all the same is traced again a
/// millionth of a cell aside.
///
/// @throws InputError  a column stays unbalanced: the mesh is not closed there
[[nodiscard]] std::vector<std::vector<Crossing>> column_crossings(const TriangleMesh& mesh, const Grid& grid);

}  // namespace kreisel::core
