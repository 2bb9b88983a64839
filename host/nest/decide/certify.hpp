// certify.hpp - is a scale that was found right, and if not, which is?
#pragma once

#include "nest/decide/feasibility.hpp"

namespace kreisel::core::nest {

/// What a test says of a scale that another way has found.
struct CertifiedScale {
  bool confirmed = false;  ///< the scale itself holds
  double scale = 0;        ///< the largest scale found to hold, within the tolerance; 0 when none does
  int tests = 0;
  Verdict verdict;  ///< of the scale itself
};

/// Tests `placement`, then looks for the largest scale near its own that still holds: upwards from a scale
/// that holds, downwards from one that doesn't, in steps that double, then by bisection. What is returned was
/// itself tested; steps may pass scales that hold between others that don't.
[[nodiscard]] CertifiedScale largest_near(Feasibility& test, Placement placement, double tolerance = 1e-4);

/// The same by `exact`; from a scale that does not hold downwards by `hybrid`, which misses none.
[[nodiscard]] CertifiedScale certify_scale(const Nesting& nesting, Placement placement,
                                           double tolerance = 1e-4);

}  // namespace kreisel::core::nest
