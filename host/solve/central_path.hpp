// central_path.hpp - where an interior-point solve goes on from, when its multipliers are known.
#pragma once

#include <span>
#include <vector>

#include "formulation/formulation.hpp"

namespace kreisel::core {

/// Moves x to the central path of given multipliers: the minimiser of
///     slope . x + x^T R x / 2 - barrier sum_i (log(x_i - lower_i) + log(upper_i - x_i)),
/// which is strictly convex, by sweeps of Gauss and Seidel. Where all multipliers are right, an
/// interior-point method has nothing left to do but to lower the barrier.
///
/// @param x        any; where the sweeps start
/// @param form     R; may be nullptr
/// @param bounds   variables without a range between them stay where they are
/// @param barrier  > 0
void to_central_path(std::span<double> x, std::span<const double> slope, const SparseForm* form,
                     const Bounds& bounds, double barrier);

}  // namespace kreisel::core
