#include "problem/principal_angle.hpp"

#include <cmath>

#include "problem/spin_terms.hpp"

namespace kreisel::core {
namespace {

constexpr int phi = 10;  // where the angle stands in (s, phi)
using Vector11 = Eigen::Matrix<double, 11, 1>;
using Matrix11 = Eigen::Matrix<double, 11, 11>;

/// g = sin 2phi (sxx - syy) / 2 + cos 2phi sxy, eq. 6 in double angles, and what else comes of them.
struct Turn {
  Turn(const Moments& s, double angle)
      : cos2(std::cos(2 * angle)), sin2(std::sin(2 * angle)), difference(s[SXX] - s[SYY]), sxy(s[SXY]) {
    residual = sin2 * difference / 2 + cos2 * sxy;
    slope = cos2 * difference - 2 * sin2 * sxy;
    by_s = sin2 / 2 * (unit_moment(SXX) - unit_moment(SYY)) + cos2 * unit_moment(SXY);
    slope_by_s = cos2 * (unit_moment(SXX) - unit_moment(SYY)) - 2 * sin2 * unit_moment(SXY);
  }
  double cos2, sin2, difference, sxy;
  double residual, slope;    ///< g and dg/dphi
  Moments by_s, slope_by_s;  ///< dg/ds, d2g/dphi ds
};

Matrix11 bordered(const Matrix10& inside, const Moments& edge, double corner) {
  Matrix11 h;
  h << inside, edge, edge.transpose(), corner;
  return h;
}

/// Ia, Ib = mean -+ half: dIa/dphi = 2 g = -dIb/dphi, and g' is what the halves differ by.
SquareRatio<11> angle_ratio(const Moments& s, double angle) {
  const Turn turn(s, angle);
  const Shift shift(s);
  const double mean = (s[SXX] + s[SYY]) / 2 + s[SZZ] - shift.value, half = turn.slope / 2;
  Vector11 by_mean = Vector11::Zero(), by_half = Vector11::Zero();
  by_mean.head<10>() = (unit_moment(SXX) + unit_moment(SYY)) / 2 + unit_moment(SZZ) - shift.gradient;
  by_half.head<10>() = turn.slope_by_s / 2;
  by_half[phi] = -2 * turn.residual;
  SquareRatio<11> r;
  r.squares = 2 * (mean * mean + half * half);  // Ia^2 + Ib^2
  r.half_gradient = 2 * (mean * by_mean + half * by_half);
  r.half_hessian = 2 * (by_mean * by_mean.transpose() + by_half * by_half.transpose() +
                        bordered(-mean * shift.hessian, -2 * half * turn.by_s, -4 * half * half));
  r.below = s[SXX] + s[SYY];
  r.gradient_below.setZero();
  r.gradient_below.head<10>() = unit_moment(SXX) + unit_moment(SYY);
  return r;
}

}  // namespace

Eigen::VectorXd PrincipalAngle::start(const Moments& s) const {
  return Eigen::VectorXd::Constant(1, std::atan2(-2 * s[SXY], s[SXX] - s[SYY]) / 2);
}

double PrincipalAngle::value(const Moments& s, const Eigen::VectorXd& a) const {
  return height_value(weights_, s) + weights_.gamma_i * angle_ratio(s, a[0]).value();
}

Eigen::VectorXd PrincipalAngle::gradient(const Moments& s, const Eigen::VectorXd& a) const {
  Vector11 g = weights_.gamma_i * angle_ratio(s, a[0]).gradient();
  g.head<10>() += height_gradient(weights_, s);
  return g;
}

Eigen::MatrixXd PrincipalAngle::hessian(const Moments& s, const Eigen::VectorXd& a) const {
  Matrix11 h = weights_.gamma_i * angle_ratio(s, a[0]).hessian();
  h.topLeftCorner<10, 10>() += height_hessian(weights_, s);
  return h;
}

Eigen::VectorXd PrincipalAngle::rows(const Moments& s, const Eigen::VectorXd& a) const {
  return Eigen::VectorXd::Constant(1, Turn(s, a[0]).residual);
}

Eigen::MatrixXd PrincipalAngle::jacobian(const Moments& s, const Eigen::VectorXd& a) const {
  const Turn turn(s, a[0]);
  Eigen::MatrixXd j(1, 11);
  j << turn.by_s.transpose(), turn.slope;
  return j;
}

Eigen::MatrixXd PrincipalAngle::curvature(const Moments& s, const Eigen::VectorXd& a,
                                          const Eigen::VectorXd& multipliers) const {
  const Turn turn(s, a[0]);
  return multipliers[0] * bordered(Matrix10::Zero(), turn.slope_by_s, -4 * turn.residual);
}

}  // namespace kreisel::core
