// explain.hpp - which constraint cannot be met, and by how much.
#pragma once

#include <optional>

#include "solve/solver.hpp"

namespace kreisel::core {

/// One of L and one of M.
struct BodyUnits {
  double millimetres, grams;
};

/// What a task that the solver found infeasible misses, a sentence a constraint, the worst first: each by
/// itself at the least; or else, where each alone can be met, all of them in the best compromise. Constraints
/// of one name are told as one, by the root of the sum of squares. In body units (masses M, first moments M
/// L, second moments M L^2), or, where those are known, as a maker has them: masses in grams; what is asked
/// of the centre of mass in millimetres, at the mass of the best there is; products of inertia in g mm^2.
///
/// Solves the same task for its margin, all constraints first, then alone each that is missed. As far as the
/// solver tells: a formulation with local minima gives no proof.
[[nodiscard]] std::string explain_infeasible(const SolverEntry& solver, const Task& task,
                                             const SolverOptions& options,
                                             const std::optional<BodyUnits>& units = {});

}  // namespace kreisel::core
