// steady_spin.hpp - turning about the vertical without wobble, and whether that is stable. [docs/physics.md]
#pragma once

#include <optional>
#include <vector>

#include "physics/rigid_body.hpp"

namespace kreisel::core {

/// A steady spin and its linear stability.
struct SteadySpin {
  Vec3 up = Vec3::UnitZ();  ///< the vertical in body axes: turned by `tilt` (radians) from body z
  double tilt = 0;
  double growth = 0;  ///< largest rate at which a small wobble grows; 0: none does
  [[nodiscard]] bool stable() const { return growth == 0; }
};

/// The steady spin at `speed` whose vertical is nearest to body z, with the spectrum of the equations of
/// motion linearised about it, for any inertia and centre of mass.
/// @param most_tilt  radians; nothing where there is none within that of body z
[[nodiscard]] std::optional<SteadySpin> steady_spin(const RigidBody& body, double speed, double most_tilt);

/// Speeds, low < high; high may be infinite.
struct SpeedRange {
  double low, high;
};

/// All speeds at which spinning about body z is linearly stable, ascending, in closed form. Takes body z as
/// principal and the centre of mass on it; what they miss that by is left out.
[[nodiscard]] std::vector<SpeedRange> stable_speeds(const RigidBody& body);

/// The least speed above which all are stable; nothing where there is none.
[[nodiscard]] std::optional<double> stable_above(const std::vector<SpeedRange>& ranges);

}  // namespace kreisel::core
