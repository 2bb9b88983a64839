// moment.hpp - solves in the ten moments themselves, on a domain's support oracle.
#pragma once

#include "solve/solver.hpp"

namespace kreisel {

/// Sequential quadratic programming over the convex set of attainable moments, each model solved by Newton's
/// method on its dual (dual.hpp), first on the coarse levels of the oracle; then Newton's method on the
/// optimality conditions as a whole, to round-off. x is the quadric. [docs/quadric.md]
///
/// options  solver.start is not used; `own`: tolerance = residual in body units, default 1e-13;
///          levels = how many of the oracle's levels to use, default all
/// @throws InputError  another option or unfit value
[[nodiscard]] Outcome solve_with_moments(const Task& task, const SolverOptions& options);

}  // namespace kreisel
