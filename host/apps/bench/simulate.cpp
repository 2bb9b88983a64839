#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/bench/outputs.hpp"
#include "apps/bench/step_line.hpp"
#include "device/device.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "physics/units.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::bench {
namespace {

/// A line of the table: what, and what it is for the solid and the part.
template <class Of>
void row(const Simulation& s, const char* what, const Of& of) {
  fmt::print("  {:<10} {:<44} {}\n", what, of(s.solid), s.hollow ? of(s.part) : "");
}

std::string eq1(const SimulatedBody& body) {
  const double rpm = body.verdict.values.at("omega_min_rpm");
  return rpm > 0 ? fmt::format("above {:.0f} rpm", rpm) : "at no speed";
}

std::string steady(const SpinAtSpeed& speed) {
  if (!speed.steady) return fmt::format("none within {} degrees of the axis", near_axis);
  const std::string grows =
      speed.stable() ? "stable"
                     : fmt::format("a wobble doubles in {:.2g} s", std::log(2) / speed.steady->growth);
  return fmt::format("{:.3f} degrees off the axis, {}", degrees(speed.steady->tilt), grows);
}

std::string motion(const SpinCheck& check) {
  if (check.at_speed.fell_at) return fmt::format("falls over within {:.2f} s", *check.at_speed.fell_at);
  return fmt::format("strays {:.2f} degrees{}", check.at_speed.largest_tilt,
                     check.motion.least_force < 0 ? ", and would hop" : "");
}

std::string drift(const Motion& motion) {
  return fmt::format("energy {:.0e}, momentum {:.0e} in {} steps", motion.energy_drift, motion.momentum_drift,
                     motion.steps);
}

/// Ranges of the scan in which the test holds.
template <class Holds>
std::string ranges(const std::vector<SpinAtSpeed>& scan, const Holds& holds) {
  std::string text;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!holds(scan[i])) continue;
    std::size_t last = i;
    while (last + 1 < scan.size() && holds(scan[last + 1])) ++last;
    text += fmt::format("{}{:.0f} to {:.0f}", text.empty() ? "" : ", ", scan[i].rpm, scan[last].rpm);
    i = last;
  }
  return text.empty() ? "at no speed" : text + " rpm";
}

void print_simulation(const Simulation& s) {
  const bool held = s.spin.contact == Contact::held;
  fmt::print("{}: {} simulated, the tip {}, from a tilt of {:g} degrees at {:.0f} rpm for {:g} s\n",
             s.body_name, s.config.problem, held ? "held in place" : "gliding on a plane",
             s.spin.tilt_degrees, s.spin.rpm, s.spin.seconds);
  fmt::print("  {:<10} {:<44} {}\n", "", "solid", s.hollow ? "part" : "");
  row(s, "eq. 1", eq1);
  row(s, held ? "held" : "gliding", [](const SimulatedBody& b) { return describe(b.spin->stable_rpm); });
  row(s, held ? "gliding" : "held", [](const SimulatedBody& b) { return describe(b.other_contact_rpm); });
  row(s, "steady", [](const SimulatedBody& b) { return steady(b.spin->at_speed); });
  row(s, "motion", [](const SimulatedBody& b) { return motion(*b.spin); });
  row(s, "drift", [](const SimulatedBody& b) { return drift(b.spin->motion); });
  if (s.spin.scan_rpm.empty()) return;
  fmt::print("  {:<10} {} speeds up to {:.0f} rpm: stable by the spectrum, and staying near the axis\n",
             "scan", s.spin.scan_rpm.size(), s.spin.scan_rpm.back());
  row(s, "spectrum", [](const SimulatedBody& b) {
    return ranges(b.spin->scan, [](const SpinAtSpeed& speed) { return speed.stable(); });
  });
  row(s, "stays", [](const SimulatedBody& b) {
    return ranges(b.spin->scan, [](const SpinAtSpeed& speed) { return speed.stays(); });
  });
}

Simulation simulated(const SimulateOptions& options) {
  const StepLine line;
  line.show("set-up");
  device::Device device(options.config.device);
  const Subject subject = options.record.empty() ? subject_of_mesh(options.config, device)
                                                 : subject_of_record(options.record, device);
  line.show("simulate");
  return simulate(subject, options.spec, device);
}

}  // namespace

int simulate_part(const SimulateOptions& options) {
  require_writable(options.json_file, "--json");
  require_writable(options.record_file, "--record");
  if (options.record.empty() == !options.mesh)
    throw InputError("simulate what? expected the record of a run (.h5), or --mesh FILE, and not both");
  SpinCheckOptions asked = options.spec.spin;
  if (!options.omega) asked.rpm = 1;  // found later
  if (const auto wrong = asked.invalid()) throw InputError(*wrong);
  const Simulation simulation = simulated(options);
  if (!options.record_file.empty()) write_simulation(options.record_file, simulation);
  const std::string json = to_json(simulation).dump(2) + "\n";
  if (options.json_file == "-") {
    fmt::print("{}", json);  // alone on standard output, for a pipe
  } else {
    if (!options.json_file.empty()) write_text(options.json_file, json);
    print_simulation(simulation);
  }
  return done;
}

}  // namespace kreisel::bench
