// safe_support.hpp - the support function of a domain, with a bound on its rounding errors.
#pragma once

#include <optional>

#include "body/body.hpp"
#include "formulation/quadric_moments.hpp"

namespace kreisel::core {

/// h(q) = min q . s over the attainable total moments of a bundle of intervals, summed on the host in double:
/// certificates do not depend on a device. [docs/quadric.md, s. 4]
class SafeSupport {
 public:
  SafeSupport(Rays rays, const MassModel& mass);

  struct Value {
    double h;       ///< as computed
    double margin;  ///< the true h is not below h - margin
    Moments s;      ///< a minimiser, as computed
  };
  [[nodiscard]] Value at(const Moments& q) const;

  /// The same of q . s + offset.
  [[nodiscard]] Value at(const Moments& q, double offset) const;

  /// Is h(q) + offset >= 0, with as much again as the rounding error to spare, so that a check by other
  /// arithmetic will find the same?
  [[nodiscard]] bool certainly_positive(const Moments& q, double offset = 0) const;

  /// About the largest t with certainly_positive(numerator - t denominator, offset); denominator . s > 0 for
  /// all attainable s. @param t  where to start  @return  nothing when there seems to be none
  [[nodiscard]] std::optional<double> largest_ratio(const Moments& numerator, const Moments& denominator,
                                                    double t, double offset = 0) const;

 private:
  Rays rays_;
  MassModel mass_;
  Moments size_;  ///< of each moment: the sum of the absolute values of all that may be added up
  double chain_;  ///< longest chain of additions
};

}  // namespace kreisel::core
