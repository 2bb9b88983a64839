// rayrep.hpp - extended ray-reps: one solid segment a ray. [RayRep, s. 2-3]
#pragma once

#include "formulation/formulation.hpp"

namespace kreisel::core {

/// Bounds of the ends of a segment: `midpoint`  zmin <= z0 <= (zmin+zmax)/2 <= z1 <= zmax  [RayRep, eq.
/// 13-14]; `ordered`  zmin <= z0 <= z1 <= zmax, the middle as a constraint a ray.
enum class RayBounds { midpoint, ordered };

struct RayRepSettings {
  /// Where both ends vary; nothing: midpoint, for a problem that fills from either end ordered.
  std::optional<RayBounds> bounds;
  bool cell_unit = true;  ///< one unit of z is a cell, not a body length
};

[[nodiscard]] Fields<RayRepSettings> rayrep_fields();

/// x = (z0, z1) of each interval of the domain, interleaved; [z0, z1] is solid, the rest of the interval
/// void. Where the problem fills rays from below, z0 = zmin stays and x is z1 of each.
///
/// Start: any of Start. Rounds each end to the nearest voxel face.
/// @param settings  RayRepSettings
std::unique_ptr<Formulation> make_rayrep(const Columns& domain, const Traits& traits,
                                         const Settings& settings, device::Device& device);

}  // namespace kreisel::core
