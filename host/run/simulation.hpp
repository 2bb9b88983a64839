// simulation.hpp - the physical check: a solid and the part made of it, set in motion side by side.
#pragma once

#include "physics/spin_check.hpp"
#include "run/provenance.hpp"
#include "run/subject.hpp"

namespace kreisel {

struct SimulationSpec {
  /// Of a spin. A speed of 0: a tenth above the least from which the part is stable.
  SpinCheckOptions spin;
  bool scan = false;  ///< over speeds up to twice the largest that matters
};

/// What one body does.
struct SimulatedBody {
  Moments moments = Moments::Zero();          ///< body frame and units
  Verdict verdict;                            ///< of the problem on these moments
  std::optional<SpinCheck> spin;              ///< of a body that is to spin
  std::vector<SpeedRange> other_contact_rpm;  ///< stable speeds with the other contact
};

struct Simulation {
  RunConfig config;
  Provenance provenance;
  std::string body_name;
  double length_mm = 1, mass_unit_grams = 1;
  SpinCheckOptions spin;  ///< as used
  bool hollow = true;
  SimulatedBody solid, part;
};

/// @throws InputError   a problem that nothing is simulated of, unfit options, a part that is stable at no
///                      speed and no speed given
/// @throws Interrupted  by Ctrl-C
[[nodiscard]] Simulation simulate(const Subject& subject, const SimulationSpec& spec,
                                  const device::Device& device);

}  // namespace kreisel
