#include "record/simulation_record.hpp"

#include <fmt/format.h>

#include <cmath>

#include "physics/units.hpp"
#include "record/common_fields.hpp"
#include "record/schema.hpp"
#include "record/with_fields.hpp"

namespace kreisel::core {

inline std::string_view to_string(Contact contact) { return name_of(contact); }

namespace fields {

template <>
struct Names<Contact> {
  static constexpr std::array all = {Contact::gliding, Contact::held, Contact::free};
};

}  // namespace fields

namespace {
namespace of_simulation {

using namespace fields;
using nlohmann::json;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The steady spin's tilt in degrees and its growth, NaN where there is none.
template <bool reading, class S, class Visit>
void steady_fields(S& speed, const Visit& visit) {
  double tilt = speed.steady ? degrees(speed.steady->tilt) : none;
  double growth = speed.steady ? speed.steady->growth : none;
  visit(tilt, growth);
  if constexpr (reading)
    if (!std::isnan(growth)) speed.steady = SteadySpin{Vec3::UnitZ(), radians(tilt), growth};
}

constexpr auto scan_columns = [](auto& column, auto& speed) {
  constexpr bool reading = std::remove_reference_t<decltype(column)>::reading;
  column("rpm", speed.rpm);
  steady_fields<reading>(speed, [&](auto& tilt, auto& growth) {
    column("growth", growth, "growth_per_s");
    column("steady_tilt", tilt, "steady_tilt_degrees");
    column.given("stable", growth == 0);
  });
  column("largest_tilt", speed.largest_tilt, "largest_tilt_degrees");
  column("fell_at", speed.fell_at, "fell_at_s");
  column.given("stays", speed.stays());
};

template <class F, class S>
void speed_fields(F& f, const std::string& file, const std::string& at, S& speed) {
  f.value(file + "rpm", at + "rpm", speed.rpm);
  steady_fields<F::reading>(speed, [&](auto& tilt, auto& growth) {
    f.value(file + "steady_tilt_degrees", at + "steady_tilt_degrees", tilt);
    f.value(file + "growth", at + "growth_per_s", growth, "1/s");
  });
  f.value(file + "largest_tilt_degrees", at + "largest_tilt_degrees", speed.largest_tilt);
  f.value(file + "fell_at", at + "fell_at_s", speed.fell_at);
  f.stored(file + "stable", speed.stable());
  f.stored(file + "stays", speed.stays());
  f.given(at + "stable", speed.stable());
  f.given(at + "stays", speed.stays());
}

/// Ranges are pairs, low and high; in JSON a high that is infinite is null.
json ranges_json(const std::vector<SpeedRange>& ranges) {
  json all = json::array();
  for (const SpeedRange& range : ranges) all.push_back({range.low, range.high});
  return all;
}

template <class F, class S>
void spin_fields(F& f, const std::string& body, S& check) {
  const std::string file = body + "/spin/", at = body + ".spin.";
  speed_fields(f, file, at, check.at_speed);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    auto& ranges = check.stable_rpm[i];
    f.rows(file + fmt::format("stable_rpm_{}", contacts[i].second), "", ranges, "1/min",
           [](auto& column, auto& range) {
             column("low", range.low);
             column("high", range.high);
           });
    f.given(at + fmt::format("stable_rpm.{}", contacts[i].second), ranges_json(ranges));
  }
  auto& motion = check.motion;
  f.value(file + "least_force", at + "least_force", motion.least_force);
  f.value(file + "steps", at + "steps", motion.steps);
  f.value(file + "energy_drift", at + "energy_drift", motion.energy_drift);
  f.value(file + "momentum_drift", at + "momentum_drift", motion.momentum_drift);
  f.value(file + "attitude_drift", "", motion.attitude_drift);
  f.bulk(body + "/spin", [&](hdf5::Group& group) {
    std::vector<double> track, attitude;
    for (std::size_t i = 0; i < motion.times.size(); ++i) {
      track.insert(track.end(), {motion.times[i], motion.tilts[i]});
      const Eigen::Vector4d& q = motion.states[i].attitude;  // x, y, z, w
      attitude.insert(attitude.end(), q.begin(), q.end());
    }
    group.write("motion", track, {motion.times.size(), 2}, {"s, degrees", {"time", "tilt"}});
    group.write("attitude", attitude, {motion.times.size(), 4}, {"", {"x", "y", "z", "w"}});
  });
  if (f.part(file + "scan", "", !check.scan.empty()))
    f.rows(file + "scan", at + "scan", check.scan, "1/min, 1/s, degrees, degrees, s", scan_columns);
  else
    f.given(at + "scan", json::array());
}

template <class F, class A>
void righting_fields(F& f, const std::string& file, const std::string& at, A& arm, double length_mm) {
  f.scaled(file + "/azimuth_degrees", at + ".azimuth_degrees", arm.azimuth, degrees(1));
  f.scaled(file + "/metacentric_height_mm", at + ".metacentric_height_mm", arm.metacentric_height, length_mm);
  std::optional<double> vanishing;
  if (arm.vanishing) vanishing = degrees(*arm.vanishing);
  f.value(file + "/vanishing_degrees", at + ".vanishing_degrees", vanishing);
  if constexpr (F::reading)
    if (vanishing) arm.vanishing = radians(*vanishing);
  struct Point {
    double heel, gz;
  };
  std::vector<Point> curve;
  for (std::size_t i = 0; i < arm.heel.size(); ++i)
    curve.push_back({degrees(arm.heel[i]), arm.gz[i] * length_mm});
  f.rows(file + "/curve", "", curve, "degrees, mm", [](auto& column, auto& point) {
    column("heel", point.heel);
    column("gz", point.gz);
  });
  json heel = json::array(), gz = json::array();
  for (const Point& point : curve) {
    heel.push_back(point.heel);
    gz.push_back(point.gz);
    if constexpr (F::reading) {
      arm.heel.push_back(radians(point.heel));
      arm.gz.push_back(point.gz / length_mm);
    }
  }
  f.given(at + ".heel_degrees", heel);
  f.given(at + ".gz_mm", gz);
}

template <class F, class B>
void standing_fields(F& f, const std::string& body, B& b) {
  if (!f.part(body + "/stand", "", !b.toppling.empty())) return;
  f.rows(body + "/stand/toppling", "", b.toppling, "degrees", [](auto& column, auto& t) {
    double azimuth = degrees(t.azimuth), angle = degrees(t.angle);
    column("azimuth", azimuth);
    column("angle", angle);
    if constexpr (std::remove_reference_t<decltype(column)>::reading) t = {radians(azimuth), radians(angle)};
  });
  if constexpr (!F::reading) {
    const Toppling least = worst(b.toppling);
    f.given(body + ".stand",
            json{{"topples_degrees", degrees(least.angle)}, {"azimuth_degrees", degrees(least.azimuth)}});
  }
}

template <class F, class B>
void body_fields(F& f, const std::string& body, B& b, double length_mm) {
  f.value(body + "/moments", "", b.moments, "M (s1), M L (sx sy sz), M L^2 (rest)");
  f.value(body + "/ok", body + ".ok", b.verdict.ok);
  f.value(body + "/text", body + ".text", b.verdict.text);
  f.names(body + "/values", "", body + ".values", b.verdict.values);
  if (f.part(body + "/stable_above", "", b.above.has_value())) {
    auto& above = engaged<F>(b.above);
    f.value(body + "/stable_above/eq1", body + ".stable_above_rpm.eq1", above.eq1);
    f.value(body + "/stable_above/gliding", body + ".stable_above_rpm.gliding", above.gliding);
    f.value(body + "/stable_above/held", body + ".stable_above_rpm.held", above.held);
    f.stored(body + "/stable_above/units", std::string("1/min"));
  }
  if (f.part(body + "/spin", "", b.spin.has_value())) spin_fields(f, body, engaged<F>(b.spin));
  if (f.part(body + "/fall", "", b.fall.has_value())) {
    auto& fall = engaged<F>(b.fall);
    f.value(body + "/fall/acceleration", body + ".fall.acceleration_g", fall.acceleration, "g");
    f.value(body + "/fall/tension", body + ".fall.tension_weights", fall.tension, "weights");
  }
  standing_fields(f, body, b);
  if (!f.part(body + "/float", "", !b.righting.empty())) return;
  if constexpr (F::reading) b.righting.resize(2);
  for (const std::size_t i : {0u, 1u}) {
    const char* name = i == 0 ? "least" : "across";
    righting_fields(f, body + "/float/" + name, body + ".float." + name, b.righting[i], length_mm);
  }
}

template <class F, class S>
void describe(F& f, S& s) {
  schema_fields(f, simulation_schema);
  config_fields(f, s.config);
  f.value("model", "model", s.body_name);
  f.value("problem", "problem", s.config.problem);
  provenance_fields(f, s.provenance);
  if (f.part("termination", "", !s.termination.empty())) f.value("termination", "termination", s.termination);
  f.late("made", "made", s.made);  // early records are of parts
  if (!s.made) return;
  f.value("length", "", s.length_mm, "mm");
  f.value("mass_unit", "", s.mass_unit_grams, "g");
  f.value("hollow", "hollow", s.hollow);
  body_fields(f, "solid", s.solid, s.length_mm);
  body_fields(f, "part", s.part, s.length_mm);
  if (f.part("contact", "", s.part.spin.has_value())) {
    f.value("contact", "contact", s.spin.contact);
    f.value("rpm", "rpm", s.spin.rpm);
    f.value("tilt_degrees", "tilt_degrees", s.spin.tilt_degrees);
    f.value("seconds", "seconds", s.spin.seconds);
  }
  if (f.part("axle", "", s.part.fall.has_value())) f.value("axle", "", s.axle_mm, "mm");
}

}  // namespace of_simulation
}  // namespace

void write_simulation(const std::filesystem::path& path, const Simulation& simulation) {
  fields::write_with(path, [&](fields::ToHdf5& f) {
    of_simulation::describe(f, simulation);
    fields::keep_summary(f, to_json(simulation));
  });
}

Simulation read_simulation(const std::filesystem::path& path) {
  Simulation simulation;
  fields::read_with(path, simulation_schema,
                    [&](fields::FromHdf5& f) { of_simulation::describe(f, simulation); });
  return simulation;
}

nlohmann::json to_json(const Simulation& simulation) {
  return fields::json_with([&](fields::ToJson& f) { of_simulation::describe(f, simulation); });
}

}  // namespace kreisel::core
