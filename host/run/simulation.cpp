#include "run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "physics/units.hpp"
#include "problem/problem.hpp"
#include "solve/interrupt.hpp"

namespace kreisel {
namespace {

Contact other(Contact contact) { return contact == Contact::held ? Contact::gliding : Contact::held; }

/// Speeds at which something changes, with either contact.
void add_bounds(std::vector<double>& speeds, const Moments& s, double length_mm) {
  for (const Contact contact : {Contact::gliding, Contact::held})
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
      fmt::format("{} can spin stably at no speed, moments {:.3g}, {:.3g} and {:.3g} about z, in "
                  "body units; expected a speed, --omega RPM, to see it fall",
                  subject.solid.name, inertia_about_centre(subject.part)(0, 0),
                  inertia_about_centre(subject.part)(1, 1), inertia_about_centre(subject.part)(2, 2)));
}

std::vector<double> scan_speeds(const Subject& subject, double rpm) {
  std::vector<double> speeds = {rpm};
  add_bounds(speeds, subject.solid.solid, subject.solid.frame.length);
  add_bounds(speeds, subject.part, subject.solid.frame.length);
  // A body all but as stable about another axis needs a speed out of all proportion.
  const double most = std::min(2 * *std::ranges::max_element(speeds), 10 * rpm);
  constexpr int count = 100;
  std::vector<double> scan;
  for (int i = 1; i <= count; ++i) scan.push_back(most * i / count);
  return scan;
}

SimulatedBody spin_of(const Moments& s, const Problem& problem, double length_mm,
                      const SpinCheckOptions& options) {
  SimulatedBody body;
  body.moments = s;
  body.verdict = problem.verify(s, length_mm);
  body.spin = check_spin(s, length_mm, options);
  body.other_contact_rpm = stable_rpm(s, length_mm, other(options.contact));
  return body;
}

}  // namespace

Simulation simulate(const Subject& subject, const SimulationSpec& spec, const device::Device& device) {
  const RunConfig& config = subject.config;
  if (config.problem != "spin")
    throw InputError(fmt::format("problem '{}' is not simulated; expected spin", config.problem));
  Simulation result;
  result.config = config;
  result.provenance = make_provenance(device);
  result.body_name = subject.solid.name;
  result.length_mm = subject.solid.frame.length;
  result.mass_unit_grams = subject.solid.mass_grams();
  result.hollow = subject.hollow;
  result.spin = spec.spin;
  if (result.spin.rpm == 0) result.spin.rpm = default_rpm(subject, spec.spin.contact);
  if (spec.scan) result.spin.scan_rpm = scan_speeds(subject, result.spin.rpm);
  result.spin.stop = interrupted;
  const auto problem = make_problem(config.problem, settings_of(config, "problem"), subject.solid);
  result.solid = spin_of(subject.solid.solid, *problem, subject.solid.frame.length, result.spin);
  stop_if_interrupted();
  result.part = spin_of(subject.part, *problem, subject.solid.frame.length, result.spin);
  stop_if_interrupted();
  return result;
}

}  // namespace kreisel
