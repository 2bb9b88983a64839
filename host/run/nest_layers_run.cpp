#include <fmt/format.h>

#include "run/nest_parts.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

/// What the result says of itself is said of the outermost nesting.
void describe_first(NestResult& result, const nest::Layer& layer) {
  result.placed = result.valid = true;
  result.scale = layer.scale;
  result.transform = layer.inner_to_world.affine();
  result.plane_point = layer.cut.offset * layer.cut.normal;
  result.plane_normal = layer.cut.normal;
  result.plus = layer.cut.plus;
  result.minus = layer.cut.minus;
  nest::CertifiedScale certified;
  certified.scale = layer.certified_scale;
  certified.confirmed = layer.certified_scale >= layer.scale;
  result.certified = certified;
}

}  // namespace

NestResult run_layers(const NestConfig& config, const NestHooks& hooks) {
  require_valid(config);
  const auto& asked = std::get<NestLayers>(config.kind);
  NestResult result;
  result.config = config;
  const Stopwatch all;
  device::Device device(config.device);
  result.provenance = make_provenance(device);
  std::vector<TriangleMesh> shapes = hooks.shapes.empty() ? shapes_of_run(config) : hooks.shapes;
  result.outer_triangles = shapes.front().triangles.size();
  result.inner_triangles = shapes[shapes.size() > 1 ? 1 : 0].triangles.size();
  nest::LayersSpec spec;
  spec.tolerances = asked.tolerances;
  spec.most = asked.layers;
  spec.cells = asked.cells;
  spec.search = search_of(asked, asked);
  spec.search.freedom.given = unplaced(asked);
  spec.search.keep_outs = asked.keep_outs;
  spec.optimise = hooks.optimise;
  result.layers = nest::nest_layers(shapes, device, spec, [&](int layer, const nest::SearchState& state) {
    hooks.control.tell(
        fmt::format("layer {}, iteration {}, scale {:.4f}", layer, state.trace.size(), state.scale));
    if (hooks.on_iteration && !hooks.on_iteration(state)) return false;
    return !hooks.control.stopped();
  });
  const nest::Layers& found = *result.layers;
  result.evaluations = 0;
  for (const nest::Layer& layer : found.layers) {
    result.evaluations += layer.evaluations;
    result.search_seconds += layer.search_seconds;
    result.certify_seconds += layer.certify_seconds;
  }
  result.setup_seconds = all.seconds() - result.search_seconds - result.certify_seconds;
  result.text =
      fmt::format("{} layer{}: {}", found.layers.size(), found.layers.size() == 1 ? "" : "s", found.ended);
  if (!found.layers.empty()) describe_first(result, found.layers.front());
  if (found.interrupted) result.ending = NestResult::Ending::interrupted;
  if (config.keep_shapes) result.shapes = std::move(shapes);
  return result;
}

}  // namespace kreisel::core
