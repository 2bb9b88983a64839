// moment.hpp - solves in the ten moments themselves, on a domain's support oracle.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "solve/dual.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {

/// Where a search in the moments is: moments, the multipliers of its rows (rows_of), and the quadric they
/// make.
struct MomentPoint {
  Moments s = Moments::Zero();
  Eigen::VectorXd multipliers;
  std::vector<bool> active;
  Moments q = Moments::Zero();
  double residual = std::numeric_limits<double>::infinity();  ///< of s = s(q) and of the rows
  std::optional<Matrix10> curvature;  ///< the support function's Hessian at q, where it is known
};

enum class Phase { going_on, converged, infeasible, stalled, interrupted };

/// A stationary point of the problem from a point near to it, of which s and the multipliers count: Newton's
/// method, and steps of the solver below where that fails. Of an infeasible problem, q separates its rows
/// from all fillings.
[[nodiscard]] Phase find_stationary(const Problem& problem, TotalSupport& oracle, double tolerance,
                                    int most_steps, MomentPoint& point);

struct MomentSettings {
  std::optional<double> tolerance;  ///< residual in body units; nothing: 1e-13, in single precision 1e-8
  std::optional<int> levels;        ///< how many of the oracle's levels to use; nothing: all
  std::optional<unsigned> seed;  ///< start from the moments that a random quadric cuts; nothing: from solid
};

[[nodiscard]] Fields<MomentSettings> moment_fields();

/// Sequential quadratic programming over the convex set of attainable moments, each model solved by Newton's
/// method on its dual (dual.hpp), first on the coarse levels of the oracle; then Newton's method on the
/// optimality conditions as a whole, to round-off. x is the quadric. [docs/quadric.md]
///
/// @param options  solver.start is not used; `from` is a quadric; `own` MomentSettings
[[nodiscard]] Outcome solve_with_moments(const Task& task, const SolverOptions& options);

}  // namespace kreisel::core
