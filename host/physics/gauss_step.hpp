// gauss_step.hpp - one step of an initial value problem by Gauss-Legendre collocation.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace kreisel::core {

/// Moves y by h along y' = f(y): three stages, order six, symmetric. Every quadratic invariant of f is one of
/// the step, too, up to round-off. [Cooper 1987; Hairer, Lubich, Wanner, Geometric Numerical Integration,
/// IV.2]
///
/// @param slopes  f at the three stages: in, a guess (those of the step before); out, of this step
/// @return        whether the fixed-point iteration converged; it does while h times f's Lipschitz constant
/// is
///                well below 1
template <int N, class F>
bool gauss_step(const F& f, Eigen::Matrix<double, N, 1>& y, double h, Eigen::Matrix<double, N, 3>& slopes) {
  static const double r = std::sqrt(15.0);
  static const Eigen::Matrix3d a = (Eigen::Matrix3d() << 5.0 / 36, 2.0 / 9 - r / 15, 5.0 / 36 - r / 30,  //
                                    5.0 / 36 + r / 24, 2.0 / 9, 5.0 / 36 - r / 24,                       //
                                    5.0 / 36 + r / 30, 2.0 / 9 + r / 15, 5.0 / 36)
                                       .finished();
  static const Eigen::Vector3d b(5.0 / 18, 4.0 / 9, 5.0 / 18);
  constexpr int most = 60;
  const double round_off = std::numeric_limits<double>::epsilon() * y.cwiseAbs().maxCoeff();
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most; ++iteration) {
    double change = 0;
    for (int stage = 0; stage < 3; ++stage) {  // a new slope serves the next stage at once
      const Eigen::Matrix<double, N, 1> slope = f(y + h * (slopes * a.row(stage).transpose()));
      change = std::max(change, h * (slope - slopes.col(stage)).cwiseAbs().maxCoeff());
      slopes.col(stage) = slope;
    }
    // At the level of round-off it does not shrink any more.
    if (change <= round_off || (change <= 16 * round_off && change >= before)) {
      y += h * (slopes * b);
      return true;
    }
    if (!std::isfinite(change)) return false;
    before = change;
  }
  return false;
}

}  // namespace kreisel::core
