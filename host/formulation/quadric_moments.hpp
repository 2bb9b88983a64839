// quadric_moments.hpp - moments of the part of a bundle of intervals where a quadric is negative
// (quadric_moments.cl).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/moments.hpp"
#include "device/buffer.hpp"
#include "domain/grid.hpp"
#include "formulation/support_oracle.hpp"

namespace kreisel::core {

/// Vertical intervals of h x h columns of a grid, body units.
struct Rays {
  Grid grid;
  std::vector<std::uint32_t> columns;  ///< pack_column() of each; a column may hold several
  std::vector<double> lower, upper;    ///< ends of each
};

/// Moments of h x h columns from the sums over the lines in their middles, in the order and with the factors
/// of quadric_moments.cl.
[[nodiscard]] Moments columns_of_lines(Moments s, double h);

/// The support oracle h(q) = min q . s over all fillings of the intervals, with its first and second
/// derivatives; compiled once, for a fixed set of intervals. [docs/quadric.md]
class QuadricMoments {
 public:
  QuadricMoments(device::Device& device, const Rays& rays);

  [[nodiscard]] Support operator()(const Moments& q, bool with_hessian);

  [[nodiscard]] std::size_t size() const { return n_; }

 private:
  device::Device* device_;
  Grid grid_;
  std::size_t n_;
  cl::Buffer columns_;
  device::RealBuffer lower_, upper_;
  struct Pass {
    device::PartialRows rows;
    cl::Kernel kernel;
  };
  Pass plain_, with_hessian_;
};

/// Double-precision references on the host, interval by interval with the quadratic formula.
namespace reference {

[[nodiscard]] MomentSums quadric_moments(const Rays& rays, const Moments& q);

/// ds/dq, from the roots inside.
[[nodiscard]] Matrix10 quadric_hessian(const Rays& rays, const Moments& q);

}  // namespace reference
}  // namespace kreisel::core
