// rayrep.hpp - extended ray-reps: one solid segment a ray. [RayRep, s. 2-3]
#pragma once

#include "formulation/formulation.hpp"

namespace kreisel::core {

/// x = (z0, z1) of each interval of the domain, interleaved; [z0, z1] is solid, the rest of the interval
/// void. Where the problem fills rays from below, z0 = zmin stays and x is z1 of each.
///
/// settings  bounds = midpoint  zmin <= z0 <= (zmin+zmax)/2 <= z1 <= zmax  [RayRep, eq. 13-14] (default, but
///                              for a problem that fills from either end)
///           bounds = ordered   zmin <= z0 <= z1 <= zmax, the middle as a constraint a ray
///           (neither matters where one end varies)
///           unit = cell | body length of one unit of z
/// Start: any of Start. Rounds each end to the nearest voxel face.
std::unique_ptr<Formulation> make_rayrep(const Columns& domain, const Traits& traits,
                                         const FormulationSettings& settings, device::Device& device);

}  // namespace kreisel::core
