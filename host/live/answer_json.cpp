#include "live/answer_json.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "design/figures_json.hpp"
#include "json_list.hpp"

namespace kreisel::core::live {
namespace {

/// Of a part that is not meshed yet: where all of it is of one material its mass tells the volume.
double volume_of(const SolvedRun& run, double grams) {
  const Body& body = run.body();
  const bool alike = body.one_material() && body.void_density == 0;
  return alike ? 1e3 * grams / body.density : std::numeric_limits<double>::quiet_NaN();
}

nlohmann::json figures(const SolvedRun& run, const Moments& moments) {
  const RunResult& r = run.result;
  const double grams = moments[S1] * r.mass_unit_grams;
  return json_of(figures_of(moments, volume_of(run, grams), r, run.problem().verify(moments, r.length_mm)));
}

}  // namespace

nlohmann::json answer_json(const SolvedRun& run) {
  const RunResult& r = run.result;
  const Body& pose = *run.stages().pose;
  const bool feasible = r.outcome.converged();
  nlohmann::json answer = {{"problem", r.config.problem},
                           {"end", to_string(r.outcome.termination)},
                           {"feasible", feasible},
                           {"objective", json_number(r.outcome.objective)},
                           {"solid_objective", json_number(r.solid_objective)},
                           {"unmet", r.infeasibility},
                           {"scope", r.scope},
                           {"solid", figures(run, r.solid)},
                           {"part", nullptr},
                           {"quadric", nullptr},
                           {"void_where", run.body().heavy_voids() ? "negative" : "positive"},
                           {"frame",
                            {{"rotation", json_rows(r.frame.rotation)},
                             {"origin", json_list(r.frame.origin)},
                             {"length", r.frame.length}}},
                           {"axis", json_list(pose.axis)},
                           {"contact", json_list(pose.contact)},
                           {"wall_mm", r.wall * r.length_mm},
                           {"density", r.density},
                           {"interior_density", r.interior_density},
                           {"void_density", r.void_density},
                           {"seconds", {{"setup", r.median.setup}, {"solve", r.median.solve}}}};
  if (feasible) {
    answer["part"] = figures(run, r.outcome.moments);
    answer["quadric"] = r.outcome.x;
  }
  return answer;
}

nlohmann::json certificate_json(const RunResult& r) {
  const Certificate& c = *r.certificate;
  return {{"kind", to_string(c.kind)},
          {"bound", json_number(c.bound)},
          {"objective", json_number(r.outcome.objective)},
          {"gap", json_number(r.gap())},
          {"seconds", c.seconds},
          {"text", c.message}};
}

}  // namespace kreisel::core::live
