// nonlinear_problem.hpp - a problem with nonlinear rows whose optimum is known by hand.
#pragma once

#include <limits>
#include <string>

#include "problem/problem.hpp"

namespace kreisel::core {

/// Move the centre of mass towards +x as far as a circle about the axis allows, of a given mass:
/// minimise -sx subject to s1 = mass, (sx^2 + sy^2) / s1^2 <= radius^2. Where the circle binds, sx = radius *
/// mass.
class WithinACircle final : public Problem, private Nonlinear {
 public:
  WithinACircle(double mass, double radius) {
    constraints_.matrix.setZero(1, 10);
    constraints_.matrix(0, S1) = 1;
    constraints_.lower = constraints_.upper = Eigen::VectorXd::Constant(1, mass);
    constraints_.names = {"mass"};
    lower_ = Eigen::VectorXd::Constant(1, -std::numeric_limits<double>::infinity());
    upper_ = Eigen::VectorXd::Constant(1, radius * radius);
  }

  [[nodiscard]] std::string_view name() const override { return "circle"; }
  [[nodiscard]] double value(const Moments& s) const override { return -s[SX]; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return -Moments::Unit(SX); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] const Nonlinear* nonlinear() const override { return this; }
  [[nodiscard]] Verdict verify(const Moments&, double) const override {
    return {.ok = true, .text = "", .values = {}};
  }

 private:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  [[nodiscard]] std::string asked_by() const override { return "the circle"; }
  [[nodiscard]] double value(const Moments& s, const Vector&) const override { return value(s); }
  [[nodiscard]] Vector gradient(const Moments& s, const Vector&) const override { return gradient(s); }
  [[nodiscard]] Matrix hessian(const Moments& s, const Vector&) const override { return hessian(s); }
  [[nodiscard]] const Vector& lower() const override { return lower_; }
  [[nodiscard]] const Vector& upper() const override { return upper_; }
  [[nodiscard]] Vector rows(const Moments& s, const Vector&) const override {
    return Vector::Constant(1, (s[SX] * s[SX] + s[SY] * s[SY]) / (s[S1] * s[S1]));
  }
  [[nodiscard]] Matrix jacobian(const Moments& s, const Vector& a) const override {
    Matrix row = Matrix::Zero(1, 10);
    const double m2 = s[S1] * s[S1];
    row(0, S1) = -2 * rows(s, a)[0] / s[S1];
    row(0, SX) = 2 * s[SX] / m2;
    row(0, SY) = 2 * s[SY] / m2;
    return row;
  }
  [[nodiscard]] Matrix curvature(const Moments& s, const Vector& a,
                                 const Vector& multipliers) const override {
    Matrix h = Matrix::Zero(10, 10);
    const double m = s[S1];
    h(S1, S1) = 6 * rows(s, a)[0] / (m * m);
    for (const int k : {SX, SY}) {
      h(k, k) = 2 / (m * m);
      h(k, S1) = h(S1, k) = -4 * s[k] / (m * m * m);
    }
    return multipliers[0] * h;
  }

  LinearConstraints constraints_;
  Vector lower_, upper_;
};

}  // namespace kreisel::core
