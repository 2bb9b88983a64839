// leaves.hpp - the leaves of an octree over the interior of a domain, and the moments of each.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "formulation/cell_moments.hpp"

namespace kreisel::core {

/// Disjoint cubes along the curve that hold every interior voxel of the domain, and each at least one.
///
/// What a leaf holds is summed on the device only where there is shell in it; of all others it is known in
/// closed form, and so is that none of their parts holds shell. So sums, and the memory for them, grow with
/// the surface; a leaf without shell is its place, eight bytes, and no more.
class Leaves {
 public:
  /// None yet. @param domain  is kept by reference
  Leaves(const Columns& domain, device::Device& device) : grid_(domain.grid), kernel_(device, domain) {}

  /// All cubes of one edge that hold interior.
  void start(int edge);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::span<const Cube> cubes() const { return {cubes_.data(), size_}; }
  /// How many interior voxels a leaf holds.
  [[nodiscard]] std::uint64_t voxels(std::size_t leaf) const;

  /// Moments of what each leaf holds at unit density, body units: a column each, exact but for a dozen
  /// roundings of each coordinate.
  void moments(Eigen::Matrix<double, 10, Eigen::Dynamic>& all) const;

  /// Marked leaves become those of their eight parts that hold interior.
  ///
  /// @param marked  one a leaf, 0 or 1; of a voxel 0
  /// @return        of each leaf, how many have come of it
  std::vector<std::uint8_t> split(std::span<const std::uint8_t> marked);

  /// Leaves [begin, end) that are, or become, one leaf.
  struct Family {
    std::uint32_t begin, end;
    Cube cube;
  };
  /// Leaves that are all there is of a cube of twice their edge, and agree, as families; all others as one
  /// each. @param most_edge  of what may become of them
  [[nodiscard]] std::vector<Family> siblings(
      int most_edge, const std::function<bool(std::size_t begin, std::size_t end)>& agree) const;
  /// @param families  from siblings()
  void merge(std::span<const Family> families);

 private:
  /// A leaf that holds shell.
  struct Mixed {
    std::uint32_t leaf;
    CubeSums sums;
  };
  [[nodiscard]] CubeSums sums(std::size_t leaf) const;

  Grid grid_;
  CellMoments kernel_;
  std::size_t size_ = 0;
  std::vector<Cube> cubes_, spare_;  ///< the first size_ count; what the next step writes to
  std::vector<Mixed> mixed_;         ///< by leaf
};

}  // namespace kreisel::core
