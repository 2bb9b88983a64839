// relaxed.hpp - how far rows are from being met.
#pragma once

#include <utility>

#include "problem/problem.hpp"

namespace kreisel::core {

/// Rows with the margin as the goal: the least t by which the worst of them is missed. Its multipliers are at
/// least 0 and their sum is 1: the quadric rows^T multipliers is at least t for every filling, so where t > 0
/// it separates them from what is asked.
class Relaxed final : public Problem {
 public:
  /// @param problem  whose objective is told beside it; outlives this
  Relaxed(const Problem& problem, LinearConstraints rows) : problem_(problem), rows_(std::move(rows)) {}

  [[nodiscard]] std::string_view name() const override { return problem_.name(); }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] Goal goal() const override { return Goal::margin; }
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
};

}  // namespace kreisel::core
