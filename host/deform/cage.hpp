// cage.hpp - the octree cells of one level that meet a solid, and a finer grid in them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Where the cells of a cage lie, and how fine the grid in them is.
struct CageGrid {
  Vec3 origin = Vec3::Zero();  ///< corner of the first cell
  double edge = 0;             ///< of a cell
  std::array<int, 3> cells{};  ///< along each axis
  int finer = 4;               ///< grid cells along the edge of a cell, >= 1

  [[nodiscard]] double h() const { return edge / finer; }  ///< edge of a grid cell
};

/// 2^level cells along the longest side of a mesh's box, in the middle of which the box lies, and 2^fine grid
/// cells. So a mirror image has the mirror image of the cage.
[[nodiscard]] CageGrid centred_cage_grid(const TriangleMesh& mesh, int level, int fine);

/// All cells that meet the solid. Their union is the cage; those of their corners that lie on its boundary
/// are the handles. A uniform grid in the cage carries what is to be interpolated. [SpinIt, s. 6]
class Cage {
 public:
  using Place = std::array<int, 3>;

  /// @param mesh  closed
  /// @throws InputError  a mesh that is not closed
  Cage(const TriangleMesh& mesh, const CageGrid& grid);
  /// The same cells with another grid in them.
  [[nodiscard]] Cage regridded(int finer) const;

  [[nodiscard]] const CageGrid& grid() const { return grid_; }
  /// Nodes of the grid in the cage, by their place on the grid.
  [[nodiscard]] const std::vector<Place>& nodes() const { return nodes_; }
  /// The lowest corners of the grid's cells in the cage.
  [[nodiscard]] const std::vector<Place>& cells() const { return cells_; }
  /// Which nodes are handles.
  [[nodiscard]] const std::vector<std::uint32_t>& handles() const { return handles_; }
  /// Of all cells of the level, x first, then y, then z: 1 for those that meet the solid.
  [[nodiscard]] const std::vector<std::uint8_t>& met() const { return met_; }

  /// The number of a node; -1: not in the cage.
  [[nodiscard]] std::int32_t node(const Place& at) const;
  [[nodiscard]] Vec3 position(const Place& node) const {
    return grid_.origin + grid_.h() * Vec3(node[0], node[1], node[2]);
  }
  /// The nodes at the corners of a grid cell in the cage: x first, then y, then z.
  [[nodiscard]] std::array<std::uint32_t, 8> corners(const Place& cell) const;

  /// A point of the cage, by the grid cell that it lies in and its place there. A point outside is moved to
  /// the nearest of the cage.
  struct Inside {
    Place cell;
    Vec3 at;                    ///< each in [0, 1]
    std::array<bool, 3> moved;  ///< along which axes

    /// What each corner of the cell counts for, in the order of corners(): tri-linear.
    [[nodiscard]] std::array<double, 8> shares() const;
  };
  [[nodiscard]] Inside inside(const Vec3& x) const;

 private:
  Cage(const CageGrid& grid, std::vector<std::uint8_t> met);
  [[nodiscard]] bool holds(const Place& cell) const;
  [[nodiscard]] std::size_t slot(const Place& node) const;

  CageGrid grid_;
  std::vector<std::uint8_t> met_;  ///< of all cells of the level
  std::vector<Place> of_level_;    ///< those met
  std::vector<std::int32_t> index_;
  std::vector<Place> nodes_, cells_;
  std::vector<std::uint32_t> handles_;
};

}  // namespace kreisel::core
