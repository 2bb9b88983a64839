// ray_moments.hpp - moments of the solid segments of rays on the device (ray_moments.cl).
#pragma once

#include <cstdint>
#include <span>

#include "body/moments.hpp"
#include "device/buffer.hpp"
#include "domain/grid.hpp"

namespace kreisel::core {

/// ix | iy << 16.
[[nodiscard]] constexpr std::uint32_t pack_column(int ix, int iy) {
  return static_cast<std::uint32_t>(ix) | static_cast<std::uint32_t>(iy) << 16;
}

/// Which ends of the rays' segments vary; the values are those of ENDS in ray_moments.cl.
enum class Ends : int { lower = 1, upper = 2, both = 3 };

/// Sums over rays of a grid; compiled once, for a fixed set of rays. Variables are the varying ends of each
/// ray (both: z0, z1, interleaved) in units of `unit` body lengths. [RayRep, s. 3.1]
class RayMoments {
 public:
  /// @param columns  pack_column() of each ray; a column may hold several
  /// @param fixed    the end of each ray that does not vary, same unit; empty when both do
  /// @throws std::invalid_argument  wrong length of `fixed`
  RayMoments(device::Device& device, const Grid& grid, std::span<const std::uint32_t> columns, double unit,
             Ends ends = Ends::both, std::span<const double> fixed = {});

  /// Ten moments at unit density about the grid's frame. @throws std::invalid_argument  wrong length
  [[nodiscard]] Moments operator()(std::span<const double> x);

  /// out[r * variables + j] = sum_k weights[r][k] ds_k/dx_j.
  void pull_back(std::span<const double> x, std::span<const Moments> weights, std::span<double> out);

  /// out[j] = sum_k weight[k] d2s_k/dx_j^2; there are no mixed terms.
  void curvature(std::span<const double> x, const Moments& weight, std::span<double> out);

  /// Relative to the sum of absolute terms: 16 roundings a term, and the summation.
  [[nodiscard]] double bound() const { return 16 * device_->unit_roundoff() + rows_.summation_bound(); }

 private:
  void set_params(cl::Kernel& kernel, std::size_t rows);
  void require_length(std::size_t values) const;

  device::Device* device_;
  Grid grid_;
  double unit_;
  std::size_t n_, variables_;
  cl::Buffer columns_;
  std::size_t stride_;  ///< of a row of `out_`, padding included
  device::RealBuffer fixed_, x_, weights_, out_;
  device::PartialRows rows_;
  cl::Kernel sum_, pull_back_, curvature_;
};

namespace reference {

/// The same in plain double on the host. @param x  z0, z1 of each ray, interleaved
[[nodiscard]] MomentSums ray_moments(const Grid& grid, std::span<const std::uint32_t> columns, double unit,
                                     std::span<const double> x);

/// Derivatives of one weighted sum, both ends varying: what pull_back() and curvature() give for it.
void ray_pull_back(const Grid& grid, std::span<const std::uint32_t> columns, double unit,
                   std::span<const double> x, const Moments& weight, std::span<double> out);
void ray_curvature(const Grid& grid, std::span<const std::uint32_t> columns, double unit,
                   std::span<const double> x, const Moments& weight, std::span<double> out);

}  // namespace reference
}  // namespace kreisel::core
