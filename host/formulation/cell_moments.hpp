// cell_moments.hpp - what of the interior lies in each cell of an octree (cell_moments.cl).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/moments.hpp"
#include "device/buffer.hpp"
#include "domain/columns.hpp"
#include "domain/octree.hpp"

namespace kreisel::core {

/// Ten sums over a cube's interior voxels, of 1, i, j, k, ij, jk, ik, ii, jj, kk, where (i, j, k) is a
/// voxel's place in the cube, from 0, in the order of Moments. Whole numbers, so a cube's are exactly its
/// parts'.
using CubeSums = std::array<std::uint64_t, 10>;

/// How many interior voxels there are in the cube.
[[nodiscard]] inline std::uint64_t voxels(const CubeSums& sums) { return sums[S1]; }

/// The sums of a cube without shell: closed forms.
[[nodiscard]] CubeSums full_cube(int edge);

/// A cube's sums from the corner of its parent: what it adds to the parent's.
[[nodiscard]] CubeSums in_parent(const CubeSums& sums, const Cube& cube);

/// Moments at unit density of the voxels that were summed, body units. Of each coordinate a dozen roundings.
[[nodiscard]] Moments moments_of(const Grid& grid, const Cube& cube, const CubeSums& sums);

/// Sums over the cells of octrees of one domain, exact on any device.
class CellMoments {
 public:
  /// @param domain  is kept by reference
  /// @param few     columns, those of all cubes counted, that the host sums sooner than a launch takes
  CellMoments(device::Device& device, const Columns& domain, std::size_t few = 32'000);

  /// @param cubes  edges up to Cube::most_edge, corners inside the grid
  [[nodiscard]] std::vector<CubeSums> operator()(std::span<const Cube> cubes);

 private:
  device::Device* device_;
  const Columns* domain_;
  std::size_t few_;
  std::vector<std::uint32_t> first_;
  cl::Buffer first_on_device_, ix_, low_, high_;
  cl::Kernel kernel_;
};

/// Runs of each column: those of column ix + nx iy are [first[c], first[c + 1]).
[[nodiscard]] std::vector<std::uint32_t> first_runs(const Columns& domain);

namespace reference {

/// Moments of each cube's interior at unit density, body units: plain double, a box for each run that is cut
/// by the cube.
[[nodiscard]] std::vector<Moments> cell_moments(const Columns& domain, std::span<const Cube> cubes);

}  // namespace reference
}  // namespace kreisel::core
