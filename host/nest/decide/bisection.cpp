#include "nest/decide/bisection.hpp"

namespace kreisel::core::nest {

FoundScale Bisection::search(const Placement& placement, const SearchLimits& limits) {
  require_valid(limits);
  Placement at = placement;
  FoundScale found;
  const auto valid = [&](double scale) {
    at.pose.scale = scale;
    ++found.tests;
    return test_->check(at).valid();
  };
  double upper = limits.upper;
  if (valid(upper)) {
    found.scale = upper;
    return found;
  }
  while (upper - found.scale > limits.tolerance) {
    if (upper <= limits.abort_below) return {0, true, found.tests};
    const double middle = 0.5 * (found.scale + upper);
    (valid(middle) ? found.scale : upper) = middle;
  }
  return found;
}

}  // namespace kreisel::core::nest
