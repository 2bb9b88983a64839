// crossings.hpp - where the columns of a grid cross a closed mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "domain/grid.hpp"

namespace kreisel::core {

/// One crossing of a column's centre line with the surface.
struct Crossing {
  double z;
  int winding;  ///< +1 entering the solid upwards, -1 leaving it
};

/// Crossings of every column's centre line, indexed ix + nx * iy: sorted by z, entering before leaving; the
/// windings of a column sum to zero.
class ColumnCrossings {
 public:
  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }  ///< columns
  [[nodiscard]] std::span<const Crossing> operator[](std::size_t column) const {
    return {all_.data() + first_[column], all_.data() + first_[column + 1]};
  }

 private:
  friend ColumnCrossings column_crossings(const TriangleMesh& mesh, const Grid& grid);
  std::vector<std::uint32_t> first_;  ///< of every column, and the end
  std::vector<Crossing> all_;
};

/// Where the columns of a grid cross a mesh.
///
/// Triangles are scan-converted in double. A line through an edge or a corner meets exactly one of the
/// triangles there, as if it were moved by an infinitesimal (eps, eps^2) [Edelsbrunner and Muecke 1990,
/// Simulation of Simplicity]. A column that round-off leaves unbalanced all the same is traced again a
/// millionth of a cell aside.
///
/// @throws InputError  a column stays unbalanced: the mesh is not closed there
[[nodiscard]] ColumnCrossings column_crossings(const TriangleMesh& mesh, const Grid& grid);

}  // namespace kreisel::core
