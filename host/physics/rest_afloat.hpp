// rest_afloat.hpp - how a floating body comes to rest that is let go upright.
#pragma once

#include "physics/righting_arm.hpp"

namespace kreisel::core {

/// The position that it slides into, displacing the same volume all the while.
struct RestAfloat {
  Vec3 up = Vec3::UnitZ();  ///< what points up then, of length 1, in the mesh's coordinates
  bool floods = false;      ///< water came over the rim of its dry space on the way
  bool sinks = false;       ///< it displaces that volume no more; `up` is where it went under
};

/// The stable equilibrium that lies downhill from `afloat.mesh` upright: the least potential energy, which is
/// by how much the centre of mass lies above the centre of buoyancy, over all ways of turning. By Newton's
/// method with the waterplane's second moments, where the energy falls by it, else by steps along the slope.
/// To 1e-9 of the mesh's size.
/// @param afloat  volume in (0, most that the mesh displaces)
[[nodiscard]] RestAfloat rest_afloat(const Afloat& afloat);

}  // namespace kreisel::core
