// plane_sweep.hpp - the carving heuristic for standing that optimisers are compared with.
#pragma once

#include "solve/solver.hpp"

namespace kreisel::core {

/// Carves voxels from the side of the target on which the centre of mass is, in the order of decreasing
/// distance from the vertical plane through the target, up to the carving with the smallest horizontal error;
/// then again from where the centre of mass is by then, until no carving brings it nearer. Whole voxels, of
/// those at the same distance the upper ones first; heights count no further. [Prevost et al. 2013, as the
/// baseline of SpinIt, fig. 12]
///
/// The target is the problem's: the base's centroid (target = centre), or the nearest point that is at least
/// the margin inside the base (target = inside), where it stops as soon as it is reached. With a margin of 0
/// that is the nearest point of the base's edge.
///
/// Starts from solid; solver.start is not used, and it has no options of its own. Any formulation whose
/// moments are linear in fills will do. `acceptable` when the error is at most 1e-3 L, else `failed`: it
/// knows no optimum.
/// @throws InputError  a problem other than stand, or target = max-tilt
[[nodiscard]] Outcome solve_with_plane_sweep(const Task& task, const SolverOptions& options);

}  // namespace kreisel::core
