#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "physics/units.hpp"
#include "record/common_groups.hpp"
#include "record/hdf5_file.hpp"
#include "record/schema.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;
using nlohmann::json;

void write_ranges(Group& group, const std::string& name, const std::vector<SpeedRange>& ranges) {
  std::vector<double> values;
  for (const SpeedRange& range : ranges) values.insert(values.end(), {range.low, range.high});
  group.write(name, values, {ranges.size(), 2}, {"1/min", {"low", "high"}});
}

void write_speed(Group& group, const SpinAtSpeed& speed) {
  group.set("rpm", speed.rpm);
  group.set("stable", speed.stable());
  group.set("stays", speed.stays());
  group.set("steady_tilt_degrees", speed.steady ? degrees(speed.steady->tilt) : nan);
  group.set("growth", speed.steady ? speed.steady->growth : nan);
  group.set("growth_units", "1/s");
  group.set("largest_tilt_degrees", speed.largest_tilt);
  group.set("fell_at", speed.fell_at.value_or(nan));
  group.set("fell_at_units", "s");
}

void write_spin(Group group, const SpinCheck& check) {
  write_speed(group, check.at_speed);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    write_ranges(group, fmt::format("stable_rpm_{}", contacts[i].second), check.stable_rpm[i]);
  const Motion& motion = check.motion;
  std::vector<double> track;
  for (std::size_t i = 0; i < motion.times.size(); ++i)
    track.insert(track.end(), {motion.times[i], motion.tilts[i]});
  group.write("motion", track, {motion.times.size(), 2}, {"s, degrees", {"time", "tilt"}});
  group.set("least_force", motion.least_force);
  group.set("steps", motion.steps);
  group.set("energy_drift", motion.energy_drift);
  group.set("momentum_drift", motion.momentum_drift);
  group.set("attitude_drift", motion.attitude_drift);
  std::vector<double> scan;
  for (const SpinAtSpeed& speed : check.scan)
    scan.insert(scan.end(), {speed.rpm, speed.steady ? speed.steady->growth : nan,
                             speed.steady ? degrees(speed.steady->tilt) : nan, speed.largest_tilt,
                             speed.fell_at.value_or(nan)});
  if (!check.scan.empty())
    group.write(
        "scan", scan, {check.scan.size(), 5},
        {"1/min, 1/s, degrees, degrees, s", {"rpm", "growth", "steady_tilt", "largest_tilt", "fell_at"}});
}

void write_righting(Group group, const RightingArm& arm, double length_mm) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < arm.heel.size(); ++i)
    rows.insert(rows.end(), {degrees(arm.heel[i]), arm.gz[i] * length_mm});
  group.write("curve", rows, {arm.heel.size(), 2}, {"degrees, mm", {"heel", "gz"}});
  group.set("azimuth_degrees", degrees(arm.azimuth));
  group.set("metacentric_height_mm", arm.metacentric_height * length_mm);
  group.set("vanishing_degrees", arm.vanishing ? degrees(*arm.vanishing) : nan);
}

void write_body(Group group, const SimulatedBody& body, double length_mm) {
  group.write("moments", {body.moments.data(), moment_names.size()}, {moment_names.size()},
              {"M (s1), M L (sx sy sz), M L^2 (rest)", {moment_names.begin(), moment_names.end()}});
  group.set("ok", body.verdict.ok);
  group.set("text", body.verdict.text);
  Group values = group.new_group("values");
  for (const auto& [name, value] : body.verdict.values) values.set(name, value);
  if (body.above) {
    Group above = group.new_group("stable_above");
    above.set("eq1", body.above->eq1);
    above.set("gliding", body.above->gliding);
    above.set("held", body.above->held);
    above.set("units", "1/min");
  }
  if (body.spin) write_spin(group.new_group("spin"), *body.spin);
  if (body.fall) {
    Group fall = group.new_group("fall");
    fall.set("acceleration", body.fall->acceleration);
    fall.set("acceleration_units", "g");
    fall.set("tension", body.fall->tension);
    fall.set("tension_units", "weights");
  }
  if (!body.toppling.empty()) {
    std::vector<double> rows;
    for (const Toppling& t : body.toppling) rows.insert(rows.end(), {degrees(t.azimuth), degrees(t.angle)});
    group.new_group("stand").write("toppling", rows, {body.toppling.size(), 2},
                                   {"degrees", {"azimuth", "angle"}});
  }
  if (!body.righting.empty()) {
    Group afloat = group.new_group("float");
    for (std::size_t i = 0; i < body.righting.size(); ++i)
      write_righting(afloat.new_group(i == 0 ? "least" : "across"), body.righting[i], length_mm);
  }
}

json to_json(const std::vector<SpeedRange>& ranges) {
  json all = json::array();
  for (const SpeedRange& range : ranges)
    all.push_back({range.low, std::isinf(range.high) ? json(nullptr) : json(range.high)});
  return all;
}

json to_json(const SpinAtSpeed& speed) {
  return {{"rpm", speed.rpm},
          {"stable", speed.stable()},
          {"stays", speed.stays()},
          {"steady_tilt_degrees", speed.steady ? json(degrees(speed.steady->tilt)) : json(nullptr)},
          {"growth_per_s", speed.steady ? json(speed.steady->growth) : json(nullptr)},
          {"largest_tilt_degrees", speed.largest_tilt},
          {"fell_at_s", speed.fell_at ? json(*speed.fell_at) : json(nullptr)}};
}

json to_json(const SpinCheck& check) {
  json spin = to_json(check.at_speed);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    spin["stable_rpm"][std::string(contacts[i].second)] = to_json(check.stable_rpm[i]);
  spin["least_force"] = check.motion.least_force;
  spin["energy_drift"] = check.motion.energy_drift;
  spin["momentum_drift"] = check.motion.momentum_drift;
  spin["steps"] = check.motion.steps;
  spin["scan"] = json::array();
  for (const SpinAtSpeed& speed : check.scan) spin["scan"].push_back(to_json(speed));
  return spin;
}

json to_json(const RightingArm& arm, double length_mm) {
  json heel = json::array(), gz = json::array();
  for (const double h : arm.heel) heel.push_back(degrees(h));
  for (const double arm_length : arm.gz) gz.push_back(arm_length * length_mm);
  return {{"azimuth_degrees", degrees(arm.azimuth)},
          {"heel_degrees", heel},
          {"gz_mm", gz},
          {"metacentric_height_mm", arm.metacentric_height * length_mm},
          {"vanishing_degrees", arm.vanishing ? json(degrees(*arm.vanishing)) : json(nullptr)}};
}

json to_json(const SimulatedBody& body, double length_mm) {
  json all = {{"ok", body.verdict.ok}, {"text", body.verdict.text}, {"values", body.verdict.values}};
  if (body.above)
    all["stable_above_rpm"] = {
        {"eq1", body.above->eq1}, {"gliding", body.above->gliding}, {"held", body.above->held}};
  if (body.spin) all["spin"] = to_json(*body.spin);
  if (body.fall)
    all["fall"] = {{"acceleration_g", body.fall->acceleration}, {"tension_weights", body.fall->tension}};
  if (!body.toppling.empty()) {
    const Toppling least = worst(body.toppling);
    all["stand"] = {{"topples_degrees", degrees(least.angle)}, {"azimuth_degrees", degrees(least.azimuth)}};
  }
  if (!body.righting.empty())
    all["float"] = {{"least", to_json(body.righting[0], length_mm)},
                    {"across", to_json(body.righting[1], length_mm)}};
  return all;
}

}  // namespace

namespace {

void write_asked(hdf5::File& file, const SimulationRun& run, const std::string& model,
                 const Provenance& provenance) {
  file.set("schema", simulation_schema);
  file.set("schema_version", simulation_schema_version);
  file.set("model", model);
  file.set("problem", run.problem);
  write_config(file.new_group("config"), describe(run));
  write_provenance(file.new_group("provenance"), provenance);
}

}  // namespace

void write_simulation_failure(const std::filesystem::path& path, const SimulationRun& run,
                              const Provenance& provenance, const std::string& message) {
  hdf5::File file = hdf5::File::create(path);
  write_asked(file, run, model_text(run), provenance);
  file.set("error", message);
  file.close();
}

void write_simulation(const std::filesystem::path& path, const Simulation& s) {
  hdf5::File file = hdf5::File::create(path);
  write_asked(file, s.config, s.body_name, s.provenance);
  file.set("made", s.made);
  if (!s.termination.empty()) file.set("termination", s.termination);
  if (!s.made) return file.close();
  file.set("length", s.length_mm);
  file.set("length_units", "mm");
  file.set("mass_unit", s.mass_unit_grams);
  file.set("mass_unit_units", "g");
  if (s.part.spin) {
    file.set("contact", name_of(s.spin.contact));
    file.set("rpm", s.spin.rpm);
    file.set("tilt_degrees", s.spin.tilt_degrees);
    file.set("seconds", s.spin.seconds);
  }
  if (s.part.fall) {
    file.set("axle", s.axle_mm);
    file.set("axle_units", "mm");
  }
  file.set("hollow", s.hollow);
  write_body(file.new_group("solid"), s.solid, s.length_mm);
  write_body(file.new_group("part"), s.part, s.length_mm);
  file.close();
}

json to_json(const Simulation& s) {
  json all = {{"model", s.body_name},
              {"problem", s.config.problem},
              {"hollow", s.hollow},
              {"made", s.made},
              {"solid", to_json(s.solid, s.length_mm)},
              {"part", to_json(s.part, s.length_mm)},
              {"config", describe(s.config)},
              {"device", s.provenance.device},
              {"commit", s.provenance.commit}};
  if (s.part.spin)
    all.update({{"contact", name_of(s.spin.contact)},
                {"rpm", s.spin.rpm},
                {"tilt_degrees", s.spin.tilt_degrees},
                {"seconds", s.spin.seconds}});
  // NaN becomes null, bytes that are no UTF-8 the replacement character.
  return json::parse(all.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace kreisel::core
