// few_rays.hpp - the support oracle of a few intervals, summed by the host.
#pragma once

#include <vector>

#include "formulation/quadric_moments.hpp"

namespace kreisel::core {

/// What QuadricMoments computes, for so few intervals that they are summed before a kernel has been launched
/// and its sums are back: the coarsest level of a solve, where most of its passes are made. Double precision.
/// [docs/performance.md, "Quadric solves"]
class FewRays {
 public:
  explicit FewRays(const Rays& rays);

  [[nodiscard]] Support operator()(const Moments& q, bool with_hessian) const;

 private:
  struct Ray {
    double x, y, lower, upper;
  };
  std::vector<Ray> rays_;
  double h_;
};

}  // namespace kreisel::core
