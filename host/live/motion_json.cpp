#include "live/motion_json.hpp"

#include "design/figures_json.hpp"
#include "json_list.hpp"
#include "physics/tilting_plane.hpp"
#include "physics/units.hpp"

namespace kreisel::core::live {
namespace {

/// Of one body: its attitudes at equal steps of time, or where the ground is tilted the way and the angle of
/// its fall.
nlohmann::json body_json(const SimulatedBody& body) {
  nlohmann::json one = {{"text", body.verdict.text}};
  if (body.spin) {
    const Motion& motion = body.spin->motion;
    one["seconds"] = motion.times.back();
    one["fell_at"] =
        body.spin->at_speed.fell_at ? json_number(*body.spin->at_speed.fell_at) : nlohmann::json();
    for (const BodyState& state : motion.states) one["attitudes"].push_back(json_list(state.attitude));
  }
  if (!body.toppling.empty()) {
    const Toppling first = worst(body.toppling);
    one["topples"] = {{"azimuth_degrees", degrees(first.azimuth)}, {"angle_degrees", degrees(first.angle)}};
  }
  return one;
}

}  // namespace

nlohmann::json motion_json(const Simulation& simulation, const Frame& frame) {
  return {{"rpm", simulation.spin.rpm},
          {"rotation", json_rows(frame.rotation)},
          {"origin", json_list(frame.origin)},
          {"solid", body_json(simulation.solid)},
          {"part", body_json(simulation.part)}};
}

}  // namespace kreisel::core::live
