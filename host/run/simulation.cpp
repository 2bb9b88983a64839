#include "run/simulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "body/hydrostatics.hpp"
#include "error.hpp"
#include "physics/units.hpp"
#include "problem/float.hpp"
#include "problem/stand.hpp"
#include "session/pipeline.hpp"

namespace kreisel::core {
namespace {

/// Speeds at which something changes, with any contact.
void add_bounds(std::vector<double>& speeds, const Moments& s, double length_mm) {
  for (const auto& [contact, name] : contacts)
    for (const SpeedRange& range : stable_rpm(s, length_mm, contact)) {
      speeds.push_back(range.low);
      if (std::isfinite(range.high)) speeds.push_back(range.high);
    }
}

double default_rpm(const Subject& subject, Contact contact) {
  const auto ranges = stable_rpm(subject.part, subject.solid.frame.length, contact);
  if (const auto above = stable_above(ranges); above && *above > 0) return 1.1 * *above;
  if (!ranges.empty() && std::isfinite(ranges.back().high))
    return (ranges.back().low + ranges.back().high) / 2;
  if (!ranges.empty()) return rpm_per_unit(subject.solid.frame.length);  // at any: one radian a unit of time
  throw InputError(
      fmt::format("{} can spin stably at no speed, moments {:.3g}, {:.3g} and "
                  "{:.3g} about z, in "
                  "body units; expected a speed, --omega RPM, to see it fall",
                  subject.solid.name, inertia_about_centre(subject.part)(0, 0),
                  inertia_about_centre(subject.part)(1, 1), inertia_about_centre(subject.part)(2, 2)));
}

std::vector<double> scan_speeds(const Subject& subject, double rpm) {
  std::vector<double> speeds = {rpm};
  add_bounds(speeds, subject.solid.solid, subject.solid.frame.length);
  add_bounds(speeds, subject.part, subject.solid.frame.length);
  // A body all but as stable about another axis needs a speed out of all
  // proportion.
  const double most = std::min(2 * *std::ranges::max_element(speeds), 10 * rpm);
  constexpr int count = 100;
  std::vector<double> scan;
  for (int i = 1; i <= count; ++i) scan.push_back(most * i / count);
  return scan;
}

std::vector<Toppling> stand_of(const Subject& subject, const Moments& s) {
  // As the problem has it: by a share of the height, or else what it rests on.
  const auto by_height = settings_as<StandSettings>(problem_settings(subject.config)).base_percent;
  const SupportPolygon base =
      by_height ? support_polygon(subject.solid, *by_height / 100) : resting_polygon(subject.solid);
  if (base.corners.empty())
    throw InputError(
        fmt::format("{} has no base to stand on as it lies; expected another --up", subject.solid.name));
  return tilt_the_plane(base, bounding_box(subject.solid.local).lo[2], centre_of_mass(s));
}

/// Of both sides the one on which it comes back from less.
RightingArm weaker_side(const Afloat& afloat, double azimuth, const Control& control) {
  RightingArm one = righting_arm(afloat, azimuth);
  control.stop_if_asked();
  RightingArm other = righting_arm(afloat, azimuth + std::numbers::pi);
  return other.vanishing && other.vanishing < one.vanishing.value_or(std::numbers::pi) ? other : one;
}

std::vector<RightingArm> float_of(const Subject& subject, const Moments& part, const Control& control) {
  const Body& solid = subject.solid;
  const auto settings = settings_as<FloatSettings>(problem_settings(subject.config));
  const Moments s = part + moments_of(settings.loads, solid);
  const double volume = s[S1] * solid.density / settings.fluid_density;
  // Nothing of it stays above the water?
  if (!(volume < (1 - 1e-6) * most_displaced(solid.local))) return {};
  const Afloat afloat{solid.local, centre_of_mass(s), volume};
  const double axis = hydrostatics(solid.local, waterline_of(solid.local, volume).value()).least_axis;
  return {weaker_side(afloat, axis, control), weaker_side(afloat, axis + std::numbers::pi / 2, control)};
}

/// rpm; NaN: at no speed.
double above(const Moments& s, double length_mm, Contact contact) {
  return stable_above(stable_rpm(s, length_mm, contact)).value_or(std::numeric_limits<double>::quiet_NaN());
}

/// What is centred spins in the air.
std::vector<Contact> usual_contacts(const ProblemEntry& problem) {
  if (problem.centred) return {Contact::free};
  return {Contact::gliding, Contact::held};
}

/// How an experiment sets a part in motion where it says nothing else. @return
/// false: no speed will do
bool choose_motion(SimulationSpec& motion, const Subject& subject) {
  const double length = subject.solid.frame.length;
  const auto contacts_to_try = motion.contact ? std::vector<Contact>{*motion.contact}
                                              : usual_contacts(find_problem(subject.config.problem));
  for (const Contact contact : contacts_to_try) {
    const double part = above(subject.part, length, contact),
                 solid = above(subject.solid.solid, length, contact);
    if (!(part > 0)) continue;
    motion.contact = contact;
    motion.spin.rpm = solid > part ? std::min(1.1 * part, std::sqrt(part * solid)) : 1.1 * part;
    return true;
  }
  return false;
}

SimulatedBody look_at(const Subject& subject, const Moments& s, const Problem& problem,
                      const Simulation& simulation, const Control& control) {
  const double length = subject.solid.frame.length;
  SimulatedBody body;
  body.moments = s;
  body.verdict = problem.verify(s, length);
  switch (find_problem(simulation.config.problem).moves) {
    case Moves::nothing:
      break;
    case Moves::topples:
      body.toppling = stand_of(subject, s);
      break;
    case Moves::heels:
      body.righting = float_of(subject, s, control);
      break;
    case Moves::spins:
      body.above = {body.verdict.values.at("omega_min_rpm"), above(s, length, Contact::gliding),
                    above(s, length, Contact::held)};
      if (simulation.spin.rpm > 0) body.spin = check_spin(s, length, simulation.spin);
      break;
  }
  if (simulation.axle_mm > 0) body.fall = yoyo_fall(s, simulation.axle_mm / length);
  control.stop_if_asked();
  return body;
}

}  // namespace

namespace {

/// @throws InputError  a problem of which nothing moves
const ProblemEntry& moving_problem(const std::string& name) {
  const ProblemEntry& problem = find_problem(name);
  if (problem.moves != Moves::nothing) return problem;
  std::vector<std::string_view> moving;
  for (const ProblemEntry& other : problems())
    if (other.moves != Moves::nothing) moving.push_back(other.name);
  throw InputError(fmt::format("there is no motion to simulate for problem '{}'; expected one of: {}", name,
                               fmt::join(moving, ", ")));
}

/// @param still  nothing is set in motion where no speed is given; else one is
/// found
Simulation simulated(const Subject& subject, const SimulationSpec& spec, bool still,
                     const device::Device& device, const Control& control) {
  const RunConfig& config = subject.config;
  const ProblemEntry& asked = moving_problem(config.problem);
  if (spec.axle_mm != 0 && (!asked.centred || !(spec.axle_mm > 0)))
    throw InputError(fmt::format("--axle {} mm for problem {}; expected a radius > 0, with problem yoyo",
                                 spec.axle_mm, config.problem));
  Simulation result;
  static_cast<RunConfig&>(result.config) = config;
  result.config.motion = spec;
  result.provenance = make_provenance(device);
  result.body_name = subject.solid.name;
  result.length_mm = subject.solid.frame.length;
  result.mass_unit_grams = subject.solid.mass_grams();
  result.hollow = subject.hollow;
  result.axle_mm = spec.axle_mm;
  result.spin = spec.spin;
  if (asked.moves == Moves::spins && !still) {
    result.spin.contact = spec.contact.value_or(usual_contacts(asked).front());
    if (result.spin.rpm == 0) result.spin.rpm = default_rpm(subject, result.spin.contact);
    if (spec.scan) result.spin.scan_rpm = scan_speeds(subject, result.spin.rpm);
    result.spin.stop = [stop = control.stop] { return stop.stop_requested(); };
  }
  const auto problem = make_problem(config.problem, settings_of(config, "problem"), subject.solid);
  result.solid = look_at(subject, subject.solid.solid, *problem, result, control);
  result.part = look_at(subject, subject.part, *problem, result, control);
  return result;
}

}  // namespace

Simulation simulate(const Subject& subject, const SimulationSpec& spec, const device::Device& device,
                    const Control& control) {
  return simulated(subject, spec, false, device, control);
}

Simulation run_simulation(const SimulationRun& asked, const Control& control) {
  const ProblemEntry& problem = moving_problem(asked.problem);
  const RunResult result = run(asked, {}, control).result;
  if (result.outcome.termination == Termination::interrupted) throw Interrupted();
  // The best compromise of what cannot be met is no part that anybody asked
  // for.
  if (result.outcome.termination == Termination::infeasible || !(result.verified.moments[S1] > 0)) {
    Simulation none;
    none.config = asked;
    none.provenance = result.provenance;
    none.body_name = result.body_name;
    none.termination = to_string(result.outcome.termination);
    none.made = false;
    return none;
  }
  device::Device device(asked.device);
  const Subject subject = subject_of_run(result, device);
  SimulationSpec motion = asked.motion;
  if (problem.centred) motion.axle_mm = asked.body.axle.radius.value_or(0);
  const bool found = problem.moves != Moves::spins || motion.spin.rpm > 0 || choose_motion(motion, subject);
  control.tell("set in motion");
  Simulation all = simulated(subject, motion, !found, device, control);
  all.config = asked;
  all.provenance = result.provenance;
  all.termination = to_string(result.outcome.termination);
  return all;
}

}  // namespace kreisel::core
