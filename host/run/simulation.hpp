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

/// A solve that makes a part, and the part set in motion beside its solid.
struct SimulationRun : RunConfig {
  SimulationSpec motion;
};

/// How it is set in motion: tip, omega, tilt, seconds, scan.
[[nodiscard]] const Fields<SimulationSpec>& motion_fields();
/// Those, and what of a solve's fields says which part is made.
[[nodiscard]] const Fields<SimulationRun>& simulation_fields();
[[nodiscard]] std::map<std::string, std::string> describe(const SimulationRun& run);
/// "ellipsoid-64-spin-simulation-1a2b3c4d"
[[nodiscard]] std::string run_name(const SimulationRun& run);

/// The least speeds, rpm, from which a body spins stably; NaN: at no speed.
struct StableAbove {
  double eq1 = 0;                ///< about the principal axis nearest to its own [SpinIt, eq. 1]
  double gliding = 0, held = 0;  ///< by the spectrum, the axis taken as principal, the tip so
};

/// What one body does; which of it depends on the problem.
struct SimulatedBody {
  Moments moments = Moments::Zero();  ///< body frame and units
  Verdict verdict;                    ///< of the problem on these moments
  std::optional<StableAbove> above;   ///< of what spins
  std::optional<SpinCheck> spin;      ///< of what spins, where a speed is known
  std::optional<YoyoFall> fall;
  std::vector<Toppling> toppling;  ///< of what stands
  /// Of what floats, body units: about the axis of the least metacentric height and the one across it, on the
  /// side on which it comes back from less. Empty for what is as dense as the fluid.
  std::vector<RightingArm> righting;
};

struct Simulation {
  SimulationRun config;
  std::string termination = {};  ///< of the solve that made the part; empty: it was made before
  bool made = true;              ///< there is a part: else nothing below says anything
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

/// Solves, makes the part, and sets it in motion. Where no speed is given it is a tenth above the part's
/// least, or half-way (as a ratio) to the solid's where that is nearer, with the first contact in which the
/// part is stable at high speeds: gliding, else held; where it is in none, nothing moves.
/// @throws InputError, Interrupted  as run() and simulate()
[[nodiscard]] Simulation run_simulation(const SimulationRun& run, const Control& control = {});

}  // namespace kreisel::core
