// spin_terms.hpp - the terms of f that the forms of spinning problems share, with their derivatives.
#pragma once

#include "problem/spinning.hpp"

namespace kreisel::core {

inline Moments unit_moment(MomentIndex k) { return Moments::Unit(k); }

/// sz^2 / s1: by as much the lateral moments of inertia about the centre of mass are less than about the
/// origin.
struct Shift {
  explicit Shift(const Moments& s);
  double value;
  Moments gradient;
  Matrix10 hessian;
};

/// squares / below^2, a sum of squares over the square of a linear form, of N variables.
template <int N>
struct SquareRatio {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  double squares, below;
  Vector half_gradient, gradient_below;  ///< half the gradient of `squares`
  Matrix half_hessian;

  [[nodiscard]] double value() const { return squares / (below * below); }
  [[nodiscard]] Vector gradient() const {
    const double k2 = below * below;
    return 2 / k2 * half_gradient - 2 * squares / (k2 * below) * gradient_below;
  }
  [[nodiscard]] Matrix hessian() const {
    const double k2 = below * below, k3 = k2 * below;
    return 2 / k2 * half_hessian -
           4 / k3 *
               (half_gradient * gradient_below.transpose() + gradient_below * half_gradient.transpose()) +
           6 * squares / (k3 * below) * gradient_below * gradient_below.transpose();
  }
};

/// What SpinWeights adds to the inertia ratio: lambda c_z + height c_z^2 + moment sz^2.
[[nodiscard]] double height_value(const SpinWeights& w, const Moments& s);
[[nodiscard]] Moments height_gradient(const SpinWeights& w, const Moments& s);
[[nodiscard]] Matrix10 height_hessian(const SpinWeights& w, const Moments& s);

}  // namespace kreisel::core
