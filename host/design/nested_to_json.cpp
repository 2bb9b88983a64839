#include <nlohmann/json.hpp>

#include "design/nested.hpp"
#include "json_list.hpp"

namespace kreisel::core {
namespace {

using nlohmann::json;

json rows(const Eigen::Affine3d& map) {
  json all = json::array();
  for (int row = 0; row < 3; ++row) {
    json one = json::array();
    for (int column = 0; column < 4; ++column) one.push_back(map(row, column));
    all.push_back(one);
  }
  return all;
}

json to_json(const NestedLayer& layer) {
  const nest::Layer& found = layer.found;
  return {
      {"scale", found.scale},
      {"certified_scale", found.certified_scale},
      {"ratio", found.ratio},
      {"longest_mm", found.longest},
      {"gap_mm", layer.gap},
      {"wall_mm", layer.wall},
      {"transform", rows(found.inner_to_world)},
      {"plane",
       {{"point", json_list(found.cut.offset * found.cut.normal)}, {"normal", json_list(found.cut.normal)}}},
      {"removal", {{"plus", json_list(found.cut.plus)}, {"minus", json_list(found.cut.minus)}}}};
}

json to_json(const NestedPart& part) {
  return {
      {"name", part.written.name},           {"file", part.written.file.string()},
      {"triangles", part.written.triangles}, {"shells", part.shells},
      {"mass_g", part.written.grams},        {"volume_mm3", 1e3 * part.written.grams / part.written.density}};
}

}  // namespace

std::string to_json(const Nested& nested) {
  const NestConfig& config = nested.spec.config;
  const NestLayers& asked = nested.spec.layers();
  json summary = {{"problem", "nest"},
                  {"model", config.outer},
                  {"outer", config.outer},
                  {"inner", config.inner.empty() ? config.outer : config.inner},
                  {"within", asked.within},
                  {"config", describe(config)},
                  {"commit", nested.provenance.commit},
                  {"device", nested.provenance.device},
                  {"repairs", nested.repairs},
                  {"size_mm", nested.size},
                  {"axis", json_list(nested.up)},
                  {"accuracy_mm", asked.tolerances.accuracy},
                  {"wall_asked_mm", asked.tolerances.wall},
                  {"density", nested.spec.density},
                  {"termination", nested.feasible() ? "valid" : "infeasible"},
                  {"ended", nested.ended},
                  {"ok", nested.ok},
                  {"text", nested.text},
                  {"seconds", {{"search", nested.search_seconds}, {"parts", nested.parts_seconds}}},
                  {"layers", json::array()},
                  {"parts", json::array()},
                  {"files", json::array()}};
  for (const NestedLayer& layer : nested.layers) summary["layers"].push_back(to_json(layer));
  for (const NestedPart& part : nested.parts) {
    summary["parts"].push_back(to_json(part));
    const std::string file = part.written.file.string();
    if (summary["files"].empty() || summary["files"].back() != file) summary["files"].push_back(file);
  }
  return summary.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace kreisel::core
