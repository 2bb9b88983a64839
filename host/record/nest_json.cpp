#include <nlohmann/json.hpp>

#include "json_list.hpp"
#include "record/nest_record.hpp"

namespace kreisel::core {
namespace {

using nlohmann::json;

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
  out["seed"] = seed_of(result.config);
  out["placements"] = accuracy.placements;
  out["nested"] = accuracy.nested;
  out["exact_agrees"] = accuracy.exact_agrees;
  out["pixels"] = accuracy.pixels;
  out["peel_disagrees"] = accuracy.peel_disagrees;
  out["errors"] = errors_of(accuracy);
  return out;
}

json rows_of(const Eigen::Matrix<double, 3, 4>& t) {
  json rows = json::array();
  for (int row = 0; row < 3; ++row) rows.push_back({t(row, 0), t(row, 1), t(row, 2), t(row, 3)});
  return rows;
}

json to_json(const nest::Layers& layers) {
  json all = json::array();
  for (const nest::Layer& layer : layers.layers)
    all.push_back({{"outer_shape", layer.outer},
                   {"inner_shape", layer.inner},
                   {"scale", layer.scale},
                   {"certified_scale", layer.certified_scale > 0 ? json(layer.certified_scale) : json()},
                   {"ratio", layer.ratio},
                   {"longest_mm", layer.longest},
                   {"thickness_mm", layer.thickness},
                   {"transform", rows_of(layer.inner_to_world.affine())},
                   {"plane",
                    {{"point", json_list(layer.cut.offset * layer.cut.normal)},
                     {"normal", json_list(layer.cut.normal)}}},
                   {"removal", {{"plus", json_list(layer.cut.plus)}, {"minus", json_list(layer.cut.minus)}}},
                   {"evaluations", layer.evaluations},
                   {"seconds",
                    {{"offset", layer.offset_seconds},
                     {"search", layer.search_seconds},
                     {"certify", layer.certify_seconds}}}});
  return all;
}

json to_json(const NestLandscape& landscape, const NestResult& result) {
  json out = common(result);
  const nest::Landscape& map = landscape.map;
  const Vec2 at = map.at(map.best());
  out["centroids"] = {map.nx, map.ny};
  out["rotations"] = std::get<NestOutlines>(result.config.kind).rotations;
  out["inside"] = map.inside;
  out["searched_to_the_end"] = map.descents;
  out["scale"] = result.scale;
  out["certified_scale"] =
      result.certified && result.certified->scale > 0 ? json(result.certified->scale) : json();
  out["best"] = {{"at", {at.x(), at.y()}}, {"degrees", landscape.degrees}};
  return out;
}

}  // namespace

json to_json(const NestResult& result) {
  if (result.accuracy) return to_json(*result.accuracy, result);
  if (result.landscape) return to_json(*result.landscape, result);
  const NestConfig& config = result.config;
  const auto* swarm = part_of<NestSearch>(config);
  const auto* by = part_of<NestDecision>(config);
  json out = common(result);
  out["variant"] = by->variant;
  out["resolution"] = by->resolution;
  out["seed"] = swarm ? json(seed_of(config)) : json();
  out["free"] = swarm ? swarm->free : "";
  out["swarm"] = swarm ? json(swarm->swarm) : json();
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
  if (result.placed) out["transform"] = rows_of(result.transform);
  out["plane"] = {{"point", json_list(result.plane_point)}, {"normal", json_list(result.plane_normal)}};
  out["removal"] = {{"plus", json_list(result.plus)}, {"minus", json_list(result.minus)}};
  if (result.layers) out["layers"] = to_json(*result.layers);
  for (const NestTiming& t : result.timings)
    out["timings"][t.variant] = {{"test_ms", t.test_ms}, {"search_ms", t.search_ms}, {"scale", t.scale}};
  return out;
}

}  // namespace kreisel::core
