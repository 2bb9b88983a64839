// principal_angle.hpp - the 2014 form of SpinIt's objective, with the angle of the lateral axes as a
// variable.
#pragma once

#include "problem/spinning.hpp"

namespace kreisel::core {

/// Minimise over (s, phi) what SpinWeights says, with Ia^2 + Ib^2 in place of tr(J^2),
///
///   Ia = cos^2 phi Jxx + sin^2 phi Jyy + sin 2phi sxy,   Ib = sin^2 phi Jxx + cos^2 phi Jyy - sin 2phi sxy,
///
/// subject to  g = cos phi sin phi (sxx - syy) + (cos^2 phi - sin^2 phi) sxy = 0.  [SpinIt 2014, eq. 6, 8]
///
/// -g is what J has off its diagonal after the turn, so tr(J^2) = Ia^2 + Ib^2 + 2 g^2: both forms have the
/// same values where g = 0, and every s has a phi with g = 0. Hence the same minima.
class PrincipalAngle final : public Nonlinear {
 public:
  explicit PrincipalAngle(const SpinWeights& weights) : weights_(weights) {}

  [[nodiscard]] std::string asked_by() const override { return "problem.form = angle"; }
  [[nodiscard]] int variables() const override { return 1; }
  [[nodiscard]] const Eigen::VectorXd& lower() const override { return zero_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const override { return zero_; }
  /// The angle with g = 0 and the larger lateral moment last.
  [[nodiscard]] Eigen::VectorXd start(const Moments& s) const override;
  [[nodiscard]] double value(const Moments& s, const Eigen::VectorXd& a) const override;
  [[nodiscard]] Eigen::VectorXd gradient(const Moments& s, const Eigen::VectorXd& a) const override;
  [[nodiscard]] Eigen::MatrixXd hessian(const Moments& s, const Eigen::VectorXd& a) const override;
  [[nodiscard]] Eigen::VectorXd rows(const Moments& s, const Eigen::VectorXd& a) const override;
  [[nodiscard]] Eigen::MatrixXd jacobian(const Moments& s, const Eigen::VectorXd& a) const override;
  [[nodiscard]] Eigen::MatrixXd curvature(const Moments& s, const Eigen::VectorXd& a,
                                          const Eigen::VectorXd& multipliers) const override;

 private:
  SpinWeights weights_;
  Eigen::VectorXd zero_ = Eigen::VectorXd::Zero(1);
};

}  // namespace kreisel::core
