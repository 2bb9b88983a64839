#include "nest/decide/certify.hpp"

#include <algorithm>

#include "nest/decide/exact.hpp"
#include "nest/decide/hybrid.hpp"

namespace kreisel::core::nest {

CertifiedScale largest_near(Feasibility& test, Placement placement, double tolerance) {
  CertifiedScale certified;
  const double scale = placement.pose.scale;
  const auto holds = [&](double s) {
    placement.pose.scale = s;
    ++certified.tests;
    const Verdict verdict = test.check(placement);
    if (s == scale) certified.verdict = verdict;
    if (verdict.valid()) certified.scale = std::max(certified.scale, s);
    return verdict.valid();
  };
  certified.confirmed = holds(scale);
  // A bracket: `low` holds, `high` does not.
  double low = scale, high = scale, step = tolerance;
  if (certified.confirmed) {
    while (holds(high = low + step)) {
      low = high;
      step *= 2;
    }
  } else {
    while ((low = high - step) > 0 && !holds(low)) {
      high = low;
      step *= 2;
    }
    if (!(low > 0)) return certified;
  }
  while (high - low > tolerance) {
    const double middle = (low + high) / 2;
    (holds(middle) ? low : high) = middle;
  }
  return certified;
}

CertifiedScale certify_scale(const Nesting& nesting, Placement placement, double tolerance) {
  Exact exact(nesting);
  const Verdict verdict = exact.check(placement);
  if (verdict.valid()) return largest_near(exact, placement, tolerance);
  const FoundScale below =
      Hybrid(nesting).search(placement, {.upper = placement.pose.scale, .tolerance = tolerance});
  CertifiedScale certified;
  if (below.scale > 0) {
    placement.pose.scale = below.scale;
    certified = largest_near(exact, placement, tolerance);
  }
  certified.confirmed = false;
  certified.verdict = verdict;
  ++certified.tests;
  return certified;
}

}  // namespace kreisel::core::nest
