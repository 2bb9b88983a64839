// motion.hpp - a body's motion over time, with how well it kept what is conserved.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "physics/rigid_body.hpp"

namespace kreisel::core {

struct MotionOptions {
  double duration = 100;  ///< body units, > 0
  int samples = 1000;     ///< equal steps of the track, >= 1
  /// Tilt (radians) at which the body counts as fallen: the motion ends there. Beyond pi: never.
  double fallen = 4;
  std::function<bool()> stop = {};  ///< asked after each sample: ends the motion there
};

/// What happened. Body units, radians.
struct Motion {
  std::vector<double> times, tilts;  ///< at the start and after each sample
  std::vector<BodyState> states;     ///< the same
  double largest_tilt = 0;           ///< of all steps
  std::optional<double> fell_at;     ///< when the tilt reached `fallen`
  double least_force = 1;            ///< of ground_force(); a gliding tip leaves the ground at 0
  std::size_t steps = 0;
  /// Largest change of the energy and of the vertical momentum, relative to the kinetic and potential energy
  /// and to the momentum there are; and how far the attitude's vertical and `up`, integrated side by side,
  /// came apart.
  double energy_drift = 0, momentum_drift = 0, attitude_drift = 0;
};

/// Integrates by Gauss-Legendre collocation (gauss_step.hpp) in equal steps, short beside the body's own
/// rates. Held or free, energy and vertical momentum are quadratic in the state, so they are kept to
/// round-off; gliding, the energy to the method's order.
/// @throws InputError  a state that is not finite, or a motion that cannot be followed, or in no reasonable
/// time
[[nodiscard]] Motion simulate(const RigidBody& body, const BodyState& start, const MotionOptions& options);

}  // namespace kreisel::core
