// bounded_quadratic.hpp - the least of a convex quadratic form in a box.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace kreisel::core {

/// out = Q x, Q symmetric and positive semidefinite.
using QuadraticForm = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& out)>;

struct BoundedMinimum {
  Eigen::VectorXd x;
  /// The most that a step down the slope, of one entry alone and within its bounds, would move: what is left
  /// of the optimality conditions, in units of x.
  double residual = 0;
};

struct BoundedOptions {
  double tolerance = 1e-7;    ///< of the residual
  int most_products = 20000;  ///< with Q
};

/// Minimises x^T Q x / 2 with lower <= x <= upper by conjugate gradients over the free entries, gradient
/// steps where a bound is met, and steps that let entries go where those promise more: MPRGP [Dostal,
/// Schoberl, Minimizing quadratic functions subject to bound constraints, 2005]. Entries are scaled to a unit
/// diagonal.
///
/// @param diagonal  of Q, > 0
/// @param start     is brought within the bounds
/// @throws Interrupted  a stop was asked for (stop.hpp)
[[nodiscard]] BoundedMinimum bounded_minimum(const QuadraticForm& Q, const Eigen::VectorXd& diagonal,
                                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                             const Eigen::VectorXd& start,
                                             const BoundedOptions& options = {});

}  // namespace kreisel::core
