// dense_void.hpp - the voxels of a set with their neighbours at hand, and where their surface is no manifold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formulation/voxel_set.hpp"

namespace kreisel {

/// Void flags on a dense grid with a layer of solid around it: cell (x, y, z) of the grid is (x+1, y+1, z+1).
class DenseVoid {
 public:
  explicit DenseVoid(const VoxelSet& set);

  [[nodiscard]] const std::array<int, 3>& n() const { return n_; }
  [[nodiscard]] std::size_t at(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * n_[1] + y) * n_[0] + x;
  }
  [[nodiscard]] bool is_void(std::size_t cell) const { return cells_[cell] & 1; }
  void set_void(std::size_t cell, bool value) {
    cells_[cell] = (cells_[cell] & ~std::uint64_t{1}) | std::uint64_t{value};
  }
  /// Index in the set of an interior cell.
  [[nodiscard]] std::size_t voxel(std::size_t cell) const { return cells_[cell] >> 1; }

  /// The eight cells from (x, y, z): bit c is set when cell (x + (c&1), y + (c>>1&1), z + (c>>2)) is void.
  [[nodiscard]] unsigned block(int x, int y, int z) const {
    unsigned bits = 0;
    for (int c = 0; c < 8; ++c)
      bits |= static_cast<unsigned>(is_void(at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)))) << c;
    return bits;
  }

 private:
  std::array<int, 3> n_;
  std::vector<std::uint64_t> cells_;  ///< voxel index, and the flag in the lowest bit
};

/// A void corner of such a block to fill, or -1 when the surface is a manifold at the block's middle.
[[nodiscard]] int offending_corner(unsigned block);

}  // namespace kreisel
