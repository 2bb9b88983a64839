// simulation.hpp - the physical check: a solid and the part made of it, beside each other.
#pragma once

#include "control.hpp"
#include "physics/righting_arm.hpp"
#include "physics/spin_check.hpp"
#include "physics/tilting_plane.hpp"
#include "physics/yoyo_fall.hpp"
#include "problem/problem.hpp"
#include "run/subject.hpp"
#include "session/provenance.hpp"

namespace kreisel::core {

struct SimulationSpec {
  /// Of what spins. A speed of 0: a tenth above the least from which the part is stable.
  SpinCheckOptions spin;
  std::optional<Contact> contact;  ///< default gliding, of a yo-yo free
  bool scan = false;               ///< over speeds up to twice the largest that matters
  double axle_mm = 0;              ///< radius of a yo-yo's axle; 0: it does not fall
};

/// What one body does; which of it depends on the problem.
struct SimulatedBody {
  Moments moments = Moments::Zero();  ///< body frame and units
  Verdict verdict;                    ///< of the problem on these moments
  std::optional<SpinCheck> spin;
  std::optional<YoyoFall> fall;
  std::vector<Toppling> toppling;  ///< of what stands
  /// Of what floats, body units: about the axis of the least metacentric height and the one across it, on the
  /// side on which it comes back from less. Empty for what is as dense as the fluid.
  std::vector<RightingArm> righting;
};

struct Simulation {
  RunConfig config;
  Provenance provenance;
  std::string body_name;
  double length_mm = 1, mass_unit_grams = 1;
  SpinCheckOptions spin;  ///< as used
  double axle_mm = 0;
  bool hollow = true;
  SimulatedBody solid, part;
};

/// @throws InputError   a problem that nothing is simulated of, unfit options, a part that is stable at no
///                      speed and no speed given
/// @throws Interrupted  by Ctrl-C
[[nodiscard]] Simulation simulate(const Subject& subject, const SimulationSpec& spec,
                                  const device::Device& device, const Control& control = {});

}  // namespace kreisel::core
