// rows.hpp - constraints alone, made in a test.
#pragma once

#include <limits>
#include <string>

#include "problem/problem.hpp"

namespace kreisel::core {

/// Feasible or not, whatever the value: szz.
class RowsProblem : public Problem {
 public:
  static constexpr double free = std::numeric_limits<double>::infinity();

  explicit RowsProblem(Goal goal = Goal::value, Filling filling = Filling::from_below)
      : goal_(goal), filling_(filling) {
    constraints_.matrix.resize(0, 10);
  }

  RowsProblem& add(const std::string& name, const Moments& form, double lower, double upper) {
    const Eigen::Index rows = constraints_.matrix.rows();
    constraints_.matrix.conservativeResize(rows + 1, 10);
    constraints_.matrix.row(rows) = form.transpose();
    constraints_.lower.conservativeResize(rows + 1);
    constraints_.upper.conservativeResize(rows + 1);
    constraints_.lower[rows] = lower;
    constraints_.upper[rows] = upper;
    constraints_.names.push_back(name);
    return *this;
  }

  [[nodiscard]] std::string_view name() const override { return "rows"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] Traits traits() const override { return {filling_}; }
  [[nodiscard]] Goal goal() const override { return goal_; }
  [[nodiscard]] double value(const Moments& s) const override { return s[SZZ]; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return Moments::Unit(SZZ); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }

 private:
  Goal goal_;
  Filling filling_;
  LinearConstraints constraints_;
};

}  // namespace kreisel::core
