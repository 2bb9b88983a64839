#include <cmath>

#include "record/hdf5_file.hpp"
#include "record/schema.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;

SimulationSummary::Body simulated_body(const Group& group) {
  SimulationSummary::Body body;
  if (group.contains("stable_above")) {
    const Group above = group.group("stable_above");
    body.above = {above.real("eq1"), above.real("gliding"), above.real("held")};
  }
  if (!group.contains("spin")) return body;
  const Group spin = group.group("spin");
  body.spectrum = spin.integer("stable") != 0                    ? "stable"
                  : std::isnan(spin.real("steady_tilt_degrees")) ? "no steady spin"
                                                                 : "unstable";
  body.largest_tilt_degrees = spin.real("largest_tilt_degrees");
  if (const double fell_at = spin.real("fell_at"); !std::isnan(fell_at)) body.fell_at = fell_at;
  return body;
}

}  // namespace

SimulationSummary read_simulation(const std::filesystem::path& path) {
  const hdf5::File file = hdf5::File::open(path);
  require_schema(file, path.string(), "a simulation", simulation_schema, simulation_schema_version);
  SimulationSummary s;
  s.path = path;
  const Group config = file.group("config"), provenance = file.group("provenance");
  for (const std::string& key : config.attributes()) s.config[key] = config.text(key);
  s.model = file.text("model");
  s.problem = file.text("problem");
  s.commit = provenance.text("commit");
  s.device = provenance.text("device");
  s.started = provenance.text("started");
  if (provenance.has("load")) s.load = provenance.real("load");
  if (file.has("error")) {
    s.error = file.text("error");
    return s;
  }
  if (file.has("termination")) s.termination = file.text("termination");
  if (file.has("made")) s.made = file.integer("made") != 0;  // early records are of parts
  if (!s.made) return s;
  if (file.has("contact")) {
    s.contact = file.text("contact");
    s.rpm = file.real("rpm");
  }
  s.solid = simulated_body(file.group("solid"));
  s.part = simulated_body(file.group("part"));
  return s;
}

}  // namespace kreisel::core
