// distance_to_rows.hpp - how far the attainable moments stay from what constraints ask for.
#pragma once

#include <stop_token>

#include "formulation/support_oracle.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// Between all C s of fillings and the box lower <= v <= upper: Euclidean, body units (masses M, first
/// moments M L, second M L^2).
struct RowDistance {
  double attained = 0;  ///< of some filling: no less than the distance
  double proved = 0;    ///< by a separating quadric: no more than the distance; <= 0 proves nothing
};

/// By Wolfe's method for the point of least norm: the hull of at most one point more than there are rows,
/// renewed by one pass of the oracle a step. Ends when both sides agree to `relative`, or below `least`.
/// [Wolfe, Finding the nearest point in a polytope, Mathematical Programming 11, 1976]
///
/// @param constraints  rows with finite bounds on both sides, one or more
[[nodiscard]] RowDistance distance_to_rows(SupportOracle& domain, const MassModel& mass,
                                           const LinearConstraints& constraints, double relative = 1e-3,
                                           double least = 1e-7, std::stop_token stop = {});

}  // namespace kreisel::core
