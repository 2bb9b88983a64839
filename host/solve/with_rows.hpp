// with_rows.hpp - a problem with other rows.
#pragma once

#include <utility>

#include "problem/problem.hpp"

namespace kreisel::core {

/// A problem's objective under rows of one's own, or how far those are from being met.
///
/// With Goal::margin it is the least t by which the worst row is missed. Its multipliers are at least 0 and
/// their sum is 1: the quadric rows^T multipliers is at least t for every filling, so where t > 0 it
/// separates them from what is asked.
class WithRows final : public Problem {
 public:
  /// @param problem  outlives this
  WithRows(const Problem& problem, LinearConstraints rows, Goal goal)
      : problem_(problem), rows_(std::move(rows)), goal_(goal) {}

  [[nodiscard]] std::string_view name() const override { return problem_.name(); }
  [[nodiscard]] Convexity convexity() const override {
    return goal_ == Goal::margin ? Convexity::linear : problem_.convexity();
  }
  [[nodiscard]] Goal goal() const override { return goal_; }
  [[nodiscard]] double value(const Moments& s) const override { return problem_.value(s); }
  [[nodiscard]] Moments gradient(const Moments& s) const override { return problem_.gradient(s); }
  [[nodiscard]] Matrix10 hessian(const Moments& s) const override { return problem_.hessian(s); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return rows_; }
  [[nodiscard]] Verdict verify(const Moments& s, double length_mm) const override {
    return problem_.verify(s, length_mm);
  }

 private:
  const Problem& problem_;
  LinearConstraints rows_;
  Goal goal_;
};

}  // namespace kreisel::core
