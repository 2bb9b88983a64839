// inside_ball.hpp - a feasibility test whose answers are plain.
#pragma once

#include "nest/decide/feasibility.hpp"

namespace kreisel::core::nest {

/// A ball of radius `scale` about the centroid is inside the unit ball.
class InsideBall final : public Feasibility {
 public:
  std::string_view name() const override { return "inside ball"; }
  Verdict check(const Placement& placement) override {
    Verdict verdict;
    if (placement.pose.centroid.norm() + placement.pose.scale > 1) verdict.fault = Fault::sticks_out;
    return verdict;
  }
};

}  // namespace kreisel::core::nest
