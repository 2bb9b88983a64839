#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/step_line.hpp"
#include "device/device.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "physics/units.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core::bench {
namespace {

/// A line of the table: what, and what it is for the solid and the part.
template <class Of>
void row(const Simulation& s, std::string_view what, const Of& of) {
  fmt::print("  {:<10} {:<56} {}\n", what, of(s.solid), s.hollow ? of(s.part) : "");
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

void print_spin(const Simulation& s) {
  if (!find_problem(s.config.problem).centred) row(s, "eq. 1", eq1);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    row(s, contacts[i].second, [&](const SimulatedBody& b) {
      const bool balanced =
          b.verdict.values.at("off_axis") <= 1e-3 && b.verdict.values.at("tilt_degrees") <= 0.1;
      return describe(b.spin->stable_rpm[i]) + (balanced ? "" : ", were it balanced");
    });
  row(s, "steady", [](const SimulatedBody& b) { return steady(b.spin->at_speed); });
  row(s, "motion", [](const SimulatedBody& b) { return motion(*b.spin); });
  row(s, "drift", [](const SimulatedBody& b) { return drift(b.spin->motion); });
  if (s.part.fall)
    row(s, "string", [](const SimulatedBody& b) {
      return fmt::format("falls at {:.3f} g, pulls with {:.3f} weights", b.fall->acceleration,
                         b.fall->tension);
    });
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

void print_stand(const Simulation& s) {
  row(s, "verdict", [](const SimulatedBody& b) {
    const double tilt = b.verdict.values.at("tilt_degrees");
    return tilt > 0 ? fmt::format("topples at a tilt of {:.2f} degrees", tilt)
                    : std::string("does not stand");
  });
  row(s, "plane", [](const SimulatedBody& b) {
    const Toppling least = worst(b.toppling);
    return fmt::format("topples at {:.2f} degrees, downhill towards {:.0f}", degrees(least.angle),
                       degrees(least.azimuth));
  });
}

void print_float(const Simulation& s) {
  row(s, "verdict", [](const SimulatedBody& b) {
    return fmt::format("metacentric height {:.3f} mm", b.verdict.values.at("metacentric_height_mm"));
  });
  for (const std::size_t i : {0u, 1u})
    row(s, i == 0 ? "righting" : "across", [&](const SimulatedBody& b) -> std::string {
      if (b.righting.empty()) return "submerged, or sinks";
      const RightingArm& arm = b.righting[i];
      const double most = *std::ranges::max_element(arm.gz) * s.length_mm;
      return fmt::format("slope {:.3f} mm, {}", arm.metacentric_height * s.length_mm,
                         arm.vanishing ? fmt::format("up to {:.2f} mm, vanishes at {:.1f} degrees", most,
                                                     degrees(*arm.vanishing))
                         : arm.metacentric_height > 0 ? "returns from any heel"
                                                      : "not righted");
    });
}

void print_simulation(const Simulation& s) {
  fmt::print("{}: {} simulated{}\n", s.body_name, s.config.problem,
             s.part.spin ? fmt::format(", {}, {:.0f} rpm for {:g} s, tilted by {:g} degrees at the start",
                                       s.spin.contact == Contact::held      ? "the tip held in place"
                                       : s.spin.contact == Contact::gliding ? "the tip gliding on a plane"
                                                                            : "in free fall",
                                       s.spin.rpm, s.spin.seconds, s.spin.tilt_degrees)
                         : "");
  fmt::print("  {:<10} {:<56} {}\n", "", "solid", s.hollow ? "part" : "");
  if (s.part.spin)
    print_spin(s);
  else if (find_problem(s.config.problem).moves == Moves::topples)
    print_stand(s);
  else
    print_float(s);
}

Simulation simulated(const SimulateOptions& options) {
  const StepLine line;
  line.show("set-up");
  device::Device device(options.config.device);
  const Subject subject = options.record.empty() ? subject_of_mesh(options.config, device)
                                                 : subject_of_record(options.record, device);
  line.show("simulate");
  return simulate(subject, options.spec, device, line.control());
}

}  // namespace

int simulate_part(const SimulateOptions& options) {
  require_writable(options.json_file, "--json");
  require_writable(options.record_file, "--record");
  if (options.record.empty() == !options.mesh)
    throw InputError("simulate what? expected the record of a run (.h5), or --mesh FILE, and not both");
  SpinCheckOptions asked = options.spec.spin;  // a typing error costs no time
  if (!options.omega) asked.rpm = 1;           // found later
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

}  // namespace kreisel::core::bench
