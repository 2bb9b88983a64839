// explain.hpp - which constraint cannot be met, and by how much.
#pragma once

#include <optional>

#include "solve/solver.hpp"

namespace kreisel::core {

/// One of L and one of M.
struct BodyUnits {
  double millimetres, grams;
};

/// One sentence for a task that the solver found infeasible: which constraints are out of reach each by
/// itself, or else which cannot be met together; all of them, the worst first, and by how much each is missed
/// at the least or in the best compromise. In body units (masses M, first moments M L, second moments M L^2),
/// or, where those are known, as a maker has them: masses in grams; what is asked of the centre of mass in
/// millimetres, at the mass of the best there is; products of inertia in g mm^2.
///
/// Solves the same task for its margin, all constraints first, then alone each that is missed. As far as the
/// solver tells: a formulation with local minima gives no proof.
[[nodiscard]] std::string explain_infeasible(const SolverEntry& solver, const Task& task,
                                             const SolverOptions& options,
                                             const std::optional<BodyUnits>& units = {});

}  // namespace kreisel::core
