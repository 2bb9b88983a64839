// voxel.hpp - the papers' baseline: one fill variable an interior voxel.
#pragma once

#include "formulation/formulation.hpp"

namespace kreisel::core {

/// x[v] in [0,1] is the fill of interior voxel v, in the order of VoxelSet; s(x) is linear. Start: any of
/// Start. Rounds at one half. [RayRep, s. 3.4]
std::unique_ptr<Formulation> make_voxel(const Columns& domain, const Traits& traits, const Settings&,
                                        device::Device& device);

}  // namespace kreisel::core
