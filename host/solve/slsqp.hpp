// slsqp.hpp - NLopt's sequential least-squares programming, which the TU Berlin implementation of Spin-It
// used.
#pragma once

#include <cstddef>

#include "solve/solver.hpp"

namespace kreisel::core {

/// More variables are refused: SLSQP keeps dense matrices of n x n (some 40 n^2 bytes), and each iteration
/// takes n^3 operations.
constexpr std::size_t slsqp_most_variables = 2000;

struct SlsqpSettings {
  double ftol_rel = 1e-10;  ///< relative change of the scaled objective at which it stops
  int maxeval = 500;        ///< evaluations of the objective, at most
};

[[nodiscard]] Fields<SlsqpSettings> slsqp_fields();

/// Sequential least-squares programming [Kraft 1988], by NLopt: minimises f(s(x)) and the formulation's
/// regulariser over x, from gradients alone.
///
/// NLopt gives no multipliers: the outcome's dual infeasibility and complementarity stay 0, and every solve
/// starts cold.
///
/// @param options  `own`: SlsqpSettings
/// @throws InputError  more than slsqp_most_variables, also after a refinement:
///                     a result whose cells are coarser than asked for would be taken for one of the others
Outcome solve_with_slsqp(const Task& task, const SolverOptions& options);

}  // namespace kreisel::core
