// voxel_moments.hpp - moments of a sparse voxel fill on the device (voxel_moments.cl).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/moments.hpp"
#include "device/buffer.hpp"
#include "domain/grid.hpp"

namespace kreisel::core {

/// ix | iy << 10 | iz << 20.
[[nodiscard]] constexpr std::uint32_t pack_cell(int ix, int iy, int iz) {
  return static_cast<std::uint32_t>(ix) | static_cast<std::uint32_t>(iy) << 10 |
         static_cast<std::uint32_t>(iz) << 20;
}

/// Sums over cells of a grid; compiled once, for a fixed set of cells.
class VoxelMoments {
 public:
  /// @param cells  pack_cell() of each voxel; indices inside the grid
  VoxelMoments(device::Device& device, const Grid& grid, std::span<const std::uint32_t> cells);

  /// Ten moments at unit density about the grid's frame. @throws std::invalid_argument  wrong length
  [[nodiscard]] Moments operator()(std::span<const double> fill);

  /// out[r * n + i] = sum_k weights[r][k] ds_k/dfill_i.
  void pull_back(std::span<const Moments> weights, std::span<double> out);

  /// Relative to the sum of absolute terms: 16 roundings a term, and the summation.
  [[nodiscard]] double bound() const { return 16 * device_->unit_roundoff() + rows_.summation_bound(); }

 private:
  device::Device* device_;
  Grid grid_;
  std::size_t n_;
  cl::Buffer cells_;
  device::RealBuffer fill_, weights_, out_;
  device::PartialRows rows_;
  cl::Kernel sum_, pull_back_;
};

namespace reference {

/// The same in plain double on the host.
[[nodiscard]] MomentSums voxel_moments(const Grid& grid, std::span<const std::uint32_t> cells,
                                       std::span<const double> fill);

/// out[i] = sum_k weight[k] ds_k/dfill_i.
void voxel_pull_back(const Grid& grid, std::span<const std::uint32_t> cells, const Moments& weight,
                     std::span<double> out);

}  // namespace reference
}  // namespace kreisel::core
