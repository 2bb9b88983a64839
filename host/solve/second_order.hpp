// second_order.hpp - the second-order condition for a strict local minimum among all fillings.
#pragma once

#include "solve/local_minimum.hpp"
#include "solve/moment.hpp"

namespace kreisel::core {

/// The condition itself: the smallest eigenvalue of B + G^+ against G^+ on the moments d in the range of G
/// with C d = 0, without an inverse of G. [docs/quadric.md, s. 3]
///
/// @param g     minus the Hessian of the support function at q, positive semidefinite
/// @param b     Hessian of f at s(q)
/// @param rows  C: those that hold as equalities and have a multiplier
/// @param zero  an eigenvalue this small, against the largest, has no sign
[[nodiscard]] LocalMinimum second_order(const Matrix10& g, const Matrix10& b,
                                        const Eigen::Matrix<double, Eigen::Dynamic, 10>& rows, double zero);

/// The same of what find_stationary() or a solve by moments ends with; one pass where `point` has no
/// curvature. `undecided` where the theorem does not apply: a margin, q that is not f's (a plane along the
/// rays), q near 0.
///
/// @param tolerance  to which the point is stationary, body units
[[nodiscard]] LocalMinimum second_order(const Problem& problem, TotalSupport& oracle,
                                        const MomentPoint& point, double tolerance);

}  // namespace kreisel::core
