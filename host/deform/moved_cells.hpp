// moved_cells.hpp - exact moments of the cells of an interior, as a cage's grid moves them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/moments.hpp"
#include "deform/cage.hpp"
#include "domain/columns.hpp"
#include "domain/octree.hpp"

namespace kreisel::core {

/// A motion of space by the displacements of a cage's grid's nodes, a row each; tri-linear within a cell of
/// the grid.
using NodeMotion = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The ten moments of each cell of an interior, moved. In a cell of the grid a moment is the integral of a
/// polynomial, of the fourth degree along each axis: three Gauss points along each give it exactly. So a
/// cell's moments are those of its parts, however it is split.
class MovedCells {
 public:
  /// @param cage    outlives it  @param domain  outlives it; its voxels fill the cells of the cage's grid,
  /// and
  ///                all interior ones are in the cage
  MovedCells(const Cage& cage, const Columns& domain);

  /// Which cells: cubes of the domain's voxels, of which the interior ones count.
  void set(std::span<const Cube> cells);
  [[nodiscard]] std::size_t size() const { return size_; }

  /// At unit density, body units: a column each.
  [[nodiscard]] Eigen::Matrix<double, 10, Eigen::Dynamic> moments(const NodeMotion& motion) const;

  /// The derivative in the motion of q . sum_k fill_k s_k, for every q.
  [[nodiscard]] std::vector<NodeMotion> gradient(const NodeMotion& motion, std::span<const double> fill,
                                                 std::span<const Moments> q) const;

 private:
  /// A box within one cell of the grid, and of one cell of the interior.
  struct Part {
    std::uint32_t owner, cell;
    std::array<float, 3> lo, hi;  ///< in the grid's cell, each in [0, 1]: whole voxels
  };
  void add(std::uint32_t owner, std::uint32_t cell, const std::array<int, 3>& lo,
           const std::array<int, 3>& hi);
  /// What of a box of voxels is interior.
  void add_inside(std::uint32_t owner, std::uint32_t cell, const std::array<int, 3>& lo,
                  const std::array<int, 3>& hi);
  [[nodiscard]] std::size_t voxel(int i, int j, int k) const {
    const auto& n = domain_.grid.n;
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(n[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(k));
  }

  const Cage& cage_;
  const Columns& domain_;
  int voxels_;                        ///< along the edge of a cell of the grid
  std::array<int, 3> first_;          ///< the place of the grid's first cell, in voxels of the domain
  std::vector<std::uint8_t> inside_;  ///< of each voxel: interior
  std::vector<std::int32_t> cell_;    ///< the number of each place's cell in the cage, or -1
  std::size_t size_ = 0;
  std::vector<std::uint8_t> left_;  ///< of a box, while it is added
  std::vector<Part> parts_;         ///< by cell
};

}  // namespace kreisel::core
