// dense_void.hpp - the voxels of a set with their neighbours at hand, and where their surface is no manifold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formulation/voxel_set.hpp"

namespace kreisel::core {

/// Void flags on a dense grid with a layer of solid around it: cell (x, y, z) of the grid is (x+1, y+1, z+1).
/// A bit each, so that a grid of 1024^3 takes 128 MiB, and the few blocks that lie on the surface are found a
/// word at a time.
class DenseVoid {
 public:
  explicit DenseVoid(const VoxelSet& set);

  [[nodiscard]] const std::array<int, 3>& n() const { return n_; }
  [[nodiscard]] bool is_void(int x, int y, int z) const { return row(y, z)[x / 64] >> x % 64 & 1; }
  void set_void(int x, int y, int z, bool value) {
    std::uint64_t& word = bits_[offset(y, z) + x / 64];
    const std::uint64_t bit = std::uint64_t{1} << x % 64;
    word = value ? word | bit : word & ~bit;
  }

  /// The eight cells from (x, y, z): bit c is set when cell (x + (c&1), y + (c>>1&1), z + (c>>2)) is void.
  [[nodiscard]] unsigned block(int x, int y, int z) const {
    unsigned bits = 0;
    for (int c = 0; c < 8; ++c)
      bits |= static_cast<unsigned>(is_void(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2))) << c;
    return bits;
  }
  /// The least x' >= x whose block at (x', y, z) holds both void and solid; n()[0] when there is none.
  [[nodiscard]] int next_mixed_block(int x, int y, int z) const;

 private:
  [[nodiscard]] std::size_t offset(int y, int z) const {
    return (static_cast<std::size_t>(z) * n_[1] + y) * words_;
  }
  [[nodiscard]] const std::uint64_t* row(int y, int z) const { return bits_.data() + offset(y, z); }

  std::array<int, 3> n_;
  std::size_t words_;  ///< a row of cells along x, and a word of solid beyond
  std::vector<std::uint64_t> bits_;
};

/// A void corner of such a block to fill, or -1 when the surface is a manifold at the block's middle.
[[nodiscard]] int offending_corner(unsigned block);

}  // namespace kreisel::core
