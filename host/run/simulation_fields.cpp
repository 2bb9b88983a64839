#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "error.hpp"
#include "run/simulation.hpp"
#include "settings/field_text.hpp"

namespace kreisel::core {
using namespace field_text;
namespace {

using M = SimulationSpec&;
using ConstM = const SimulationSpec&;
using S = std::string_view;

Contact contact_of(S name, S value) {
  for (const auto& [contact, text] : contacts)
    if (text == value) return contact;
  refuse(name, value, "gliding, held or free");
}

double above_0(S name, S value) {
  const double v = number(name, value);
  if (!(v > 0)) refuse(name, value, "a number > 0");
  return v;
}

Fields<SimulationSpec> make_motion_fields() {
  return grouped<SimulationSpec>(
      "motion",
      {chosen_from<SimulationSpec>(
           [] {
             std::vector<std::string> names;
             for (const auto& [contact, text] : contacts) names.emplace_back(text);
             return names;
           },
           {"touch", "",
            "how the tip touches the ground: gliding without friction (default), held in its place, or free "
            "of it (default of yoyo)",
            [](M m, S k, S v) { m.contact = contact_of(k, v); },
            [](ConstM m) { return m.contact ? std::string(name_of(*m.contact)) : ""; }}),
       {"omega", "rpm", "speed at the start; default: a tenth above the least from which the part is stable",
        [](M m, S k, S v) { m.spin.rpm = above_0(k, v); },
        [](ConstM m) { return m.spin.rpm > 0 ? fmt::format("{}", m.spin.rpm) : ""; }},
       {"tilt", "degrees", "tilt at the start; default 1",
        [](M m, S k, S v) { m.spin.tilt_degrees = above_0(k, v); },
        [](ConstM m) { return fmt::format("{}", m.spin.tilt_degrees); }},
       {"seconds", "s", "how long to simulate; default 10",
        [](M m, S k, S v) { m.spin.seconds = above_0(k, v); },
        [](ConstM m) { return fmt::format("{}", m.spin.seconds); }},
       one_of<SimulationSpec>(
           "scan", "yes: simulate over a hundred speeds, too; default no", {"no", "yes"},
           [](auto& m) -> auto& { return m.scan; })});
}

}  // namespace

const Fields<SimulationSpec>& motion_fields() {
  static const Fields<SimulationSpec> all = make_motion_fields();
  return all;
}

const Fields<SimulationRun>& simulation_fields() {
  static const Fields<SimulationRun> all =
      joined<SimulationRun>(asked_fields(), rounding_fields(),
                            fields_of_part<SimulationRun>(
                                motion_fields(), [](auto& run) -> auto& { return run.motion; }));
  return all;
}

std::map<std::string, std::string> describe(const SimulationRun& run) {
  auto said = describe(simulation_fields(), run, SimulationRun());
  said.insert(run.settings.begin(), run.settings.end());
  return said;
}

std::string run_name(const SimulationRun& run) { return run_name(run, describe(run), "simulation"); }

}  // namespace kreisel::core
