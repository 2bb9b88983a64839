#include <nlohmann/json.hpp>

#include "record/nest_record.hpp"

namespace kreisel {
namespace {

using nlohmann::json;

json list(const Vec3& v) { return {v[0], v[1], v[2]}; }

json errors_of(const nest::Accuracy& accuracy) {
  json errors = json::array();
  for (const nest::SampledError& e : accuracy.errors)
    errors.push_back({{"resolution", e.resolution},
                      {"optimistic", e.optimistic},
                      {"pessimistic", e.pessimistic},
                      {"missed", e.missed},
                      {"median", e.median},
                      {"percentile_95", e.most_of},
                      {"largest", e.largest}});
  return errors;
}

json common(const NestResult& result) {
  const NestConfig& config = result.config;
  return {{"outer", config.outer},
          {"inner", config.inner.empty() ? config.outer : config.inner},
          {"seconds",
           {{"setup", result.setup_seconds},
            {"search", result.search_seconds},
            {"certify", result.certify_seconds},
            {"total", result.setup_seconds + result.search_seconds + result.certify_seconds}}},
          {"termination", termination_of(result)},
          {"text", result.text},
          {"triangles", result.outer_triangles + result.inner_triangles},
          {"config", describe(config)},
          {"device", result.provenance.device},
          {"commit", result.provenance.commit}};
}

json to_json(const nest::Accuracy& accuracy, const NestResult& result) {
  json out = common(result);
  out["seed"] = result.config.search.swarm.seed;
  out["placements"] = accuracy.placements;
  out["nested"] = accuracy.nested;
  out["exact_agrees"] = accuracy.exact_agrees;
  out["pixels"] = accuracy.pixels;
  out["peel_disagrees"] = accuracy.peel_disagrees;
  out["errors"] = errors_of(accuracy);
  return out;
}

}  // namespace

json to_json(const NestResult& result) {
  if (result.accuracy) return to_json(*result.accuracy, result);
  const NestConfig& config = result.config;
  const bool swarm = !config.free.empty();
  json out = common(result);
  out["variant"] = config.variant;
  out["resolution"] = config.resolution;
  out["seed"] = swarm ? json(config.search.swarm.seed) : json();
  out["free"] = config.free;
  out["swarm"] = swarm ? json(config.swarm) : json();
  if (swarm)
    for (const nest::SwarmStep& step : result.trace)
      out["trace"].push_back({step.iteration, step.evaluations, step.best});
  out["evaluations"] = result.evaluations;
  out["valid"] = result.valid;
  out["scale"] = result.placed ? json(result.scale) : json();
  const auto& certified = result.certified;
  out["confirmed"] = certified && certified->confirmed;
  out["certified_scale"] = certified && certified->scale > 0 ? json(certified->scale) : json();
  out["sampled_scale"] = result.sampled_scale ? json(*result.sampled_scale) : json();
  out["transform"] = nullptr;
  if (result.placed) {
    out["transform"] = json::array();
    for (int row = 0; row < 3; ++row) {
      const auto& t = result.transform;
      out["transform"].push_back({t(row, 0), t(row, 1), t(row, 2), t(row, 3)});
    }
  }
  out["plane"] = {{"point", list(result.plane_point)}, {"normal", list(result.plane_normal)}};
  out["removal"] = {{"plus", list(result.plus)}, {"minus", list(result.minus)}};
  for (const NestTiming& t : result.timings)
    out["timings"][t.variant] = {{"test_ms", t.test_ms}, {"search_ms", t.search_ms}, {"scale", t.scale}};
  return out;
}

}  // namespace kreisel
