#include "live/nestings.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <set>
#include <utility>

#include "error.hpp"
#include "json_list.hpp"
#include "nest/search/optimise.hpp"
#include "run/nest_parts.hpp"
#include "settings/field_text.hpp"
#include "stopwatch.hpp"

namespace kreisel::core::live {
namespace {

constexpr double beyond = 1.002;  // of the largest scale: what is met there is what blocks

const NestKindEntry& kind_named(std::string_view kind) {
  return *std::ranges::find(nest_kinds(), kind, &NestKindEntry::name);
}

Fields<NestConfig> open_fields_of(std::string_view kind) {
  static const std::set<std::string_view> names = {"rotation",  "plane",  "removal", "centroid",  "through",
                                                   "tolerance", "free",   "up",      "keep-out",  "particles",
                                                   "seed",      "climbs", "seconds", "iterations"};
  Fields<NestConfig> open;
  for (const Field<NestConfig>& field : kind_named(kind).fields)
    if (names.contains(field.name)) open.push_back(field);
  return open;
}

}  // namespace

const Fields<NestConfig>& nest_fields(std::string_view kind) {
  static const Fields<NestConfig> scale = open_fields_of("scale"), swarm = open_fields_of("swarm");
  return kind == "swarm" ? swarm : scale;
}

NestConfig usual_nesting(std::string_view kind) {
  NestConfig config;
  config.kind = kind_named(kind).empty;
  return config;
}

Nestings::Nestings(TriangleMesh outer, TriangleMesh inner, Send send)
    : nesting_(std::move(outer), std::move(inner)), hybrid_(nesting_), send_(std::move(send)) {}

nest::Placement Nestings::placement_of(const NestConfig& config) const {
  const NestPlace& place = *part_of<NestPlace>(config);
  nest::Placement placement = unplaced(*part_of<NestTurn>(config));
  placement.pose.centroid = nesting_.to_units(place.centroid.value_or(nesting_.outer_centroid()));
  const Vec3 through = place.through ? nesting_.to_units(*place.through) : placement.pose.centroid;
  placement.cut.offset = placement.cut.normal.dot(through);
  nest::require_valid(placement);
  return placement;
}

/// As a page draws it, and as the fields say it.
nlohmann::json Nestings::placement_json(const nest::Placement& placement) const {
  const Eigen::Matrix<double, 3, 4> transform = nesting_.transform(placement.pose);
  nlohmann::json rows = nlohmann::json::array();
  for (int row = 0; row < 3; ++row) rows.push_back(json_list(transform.row(row).transpose()));
  const Eigen::AngleAxisd turn(placement.pose.rotation);
  const Vec3 degrees = turn.axis() * turn.angle() * 180 / std::numbers::pi;
  const Vec3 through = nesting_.to_file(placement.cut.offset * placement.cut.normal),
             centroid = nesting_.to_file(placement.pose.centroid);
  using field_text::text_of;
  return {{"scale", placement.pose.scale},
          {"transform", rows},
          {"plane_point", json_list(through)},
          {"plane_normal", json_list(placement.cut.normal)},
          {"plus", json_list(placement.cut.plus)},
          {"minus", json_list(placement.cut.minus)},
          {"fields",
           {{"rotation", text_of(degrees)},
            {"centroid", text_of(centroid)},
            {"plane", text_of(placement.cut.normal)},
            {"through", text_of(through)},
            {"removal", text_of(placement.cut.plus) + " " + text_of(placement.cut.minus)}}}};
}

void Nestings::ask(const nlohmann::json& id, const NestConfig& config) {
  const Stopwatch watch;
  nest::Placement placement = placement_of(config);
  nest::SearchLimits limits;
  limits.upper = nesting_.largest_scale();
  limits.tolerance = part_of<NestDecision>(config)->tolerance;
  const nest::FoundScale found = hybrid_.search(placement, limits);
  const bool valid = found.scale > 0;
  placement.pose.scale = valid ? std::min(beyond * found.scale, limits.upper) : limits.tolerance;
  const nest::Verdict verdict = hybrid_.check(placement);
  if (valid) placement.pose.scale = found.scale;
  nlohmann::json answer = placement_json(placement);
  answer.update({{"do", "nesting"}, {"id", id}, {"valid", valid}, {"blocked_at", nullptr}, {"text", ""}});
  if (!verdict.valid()) {
    answer["blocked_at"] = json_list(nesting_.to_file(verdict.point));
    answer["half"] = verdict.half == 0 ? "above" : "below";
    answer["text"] = nest::to_string(verdict, nesting_);
  }
  answer["seconds"] = watch.seconds();
  send_(live::message(answer, "nesting"));
}

void Nestings::optimise(const nlohmann::json& id, const NestConfig& config, const std::stop_token& stop) {
  const NestSwarm& asked = std::get<NestSwarm>(config.kind);
  nest::OptimiseSpec spec = search_of(asked, asked);
  spec.freedom.given = placement_of(config);
  for (const nest::KeepOut& ball : asked.keep_outs)
    spec.keep_outs.push_back({nesting_.to_units(ball.centre), ball.radius / nesting_.unit()});
  device::Device device(config.device);
  const nest::PlacementSpace space(spec.freedom, nesting_.outer_box(), false, nesting_.largest_scale());
  const auto begin = space.position(spec.freedom.given);
  spec.guest = [&](const nest::SearchState& state) {
    return state.swarm.iteration == 1 ? begin : std::vector<double>();
  };
  double shown = 0;
  const auto show = [&](nest::Placement best, double scale, std::size_t iterations, bool over) {
    best.pose.scale = scale;
    nlohmann::json said = placement_json(best);
    said.update({{"do", over ? "optimised" : "better"}, {"id", id}, {"iterations", iterations}});
    send_(live::message(said, over ? "" : "better"));
  };
  const nest::OptimiseResult found =
      nest::optimise(nesting_, device, spec, [&](const nest::SearchState& state) {
        if (state.scale > shown && !state.best.empty()) {
          shown = state.scale;
          show(space.placement(state.best), state.scale, state.trace.size(), false);
        }
        return !stop.stop_requested();
      });
  if (!found.best)
    throw InputError("nothing that nests was found; expected another placement, or more that is free");
  show(*found.best, found.best->pose.scale, found.state.trace.size(), true);
}

}  // namespace kreisel::core::live
