// meet_constraints.hpp - rounds whole voxels so that the part keeps what the optimum met.
#pragma once

#include "formulation/voxel_set.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// Fills or empties single voxels at the ends of void runs along z, each at most once, until the problem's
/// constraints hold to within one voxel or no such move helps. Rounding every ray to its nearest voxel misses
/// them by up to half a layer: the rays under a plane all round the same way. At the optimum a voxel on the
/// void's surface changes the objective as the constraints do, so the moves cost next to nothing.
///
/// @param set  well composed (make_well_composed()), and it stays so
/// @return     how many voxels were moved
std::size_t meet_constraints(VoxelSet& set, const Problem& problem, const MassModel& mass);

}  // namespace kreisel::core
