#include "apps/bench/nest_print.hpp"

#include <fmt/format.h>

namespace kreisel::core::bench {

void print_layers(const NestResult& result) {
  const auto& asked = std::get<NestLayers>(result.config.kind);
  const nest::Tolerances& tolerances = asked.tolerances;
  fmt::print("{}: layers, each a {} swarm over {}\n", shapes_text(result.config), asked.swarm, asked.free);
  fmt::print("  walls      {:g} mm at least, and {:g} mm for the printer\n", tolerances.wall,
             tolerances.accuracy);
  fmt::print("  layer        mm   of the outer       scale   certified     wall        s\n");
  for (std::size_t k = 0; k < result.layers->layers.size(); ++k) {
    const nest::Layer& layer = result.layers->layers[k];
    fmt::print("  {:>5} {:>9.2f} {:>14.4f} {:>11.5g} {:>11.5g} {:>8.3f} {:>8.2f}\n", k + 1, layer.longest,
               layer.ratio, layer.scale, layer.certified_scale, layer.thickness,
               layer.offset_seconds + layer.search_seconds + layer.certify_seconds);
  }
  fmt::print("  answer     {}\n", result.text);
  fmt::print(
      "  time       {:.3f} s search ({} evaluations), {:.3f} s set-up and offsets, {:.3f} s certification\n",
      result.search_seconds, result.evaluations, result.setup_seconds, result.certify_seconds);
}

void print_landscape(const NestResult& result) {
  const nest::Landscape& map = result.landscape->map;
  fmt::print("{}: outlines, cut level through the inner one's centroid\n", shapes_text(result.config));
  fmt::print("  outlines   of {} and {} points\n", result.landscape->outlines.outer.size(),
             result.landscape->outlines.inner.size());
  fmt::print("  answer     {}\n", result.text);
  if (result.valid) fmt::print("  scale      {:.6g}\n", result.scale);
  if (result.certified && result.certified->scale > 0)
    fmt::print("  certified  valid on solids of those outlines at {:.6g}\n", result.certified->scale);
  fmt::print("  time       {:.3f} s for {:.4g} placements, {} of them searched to the end\n", map.seconds,
             static_cast<double>(result.evaluations), map.descents);
}

}  // namespace kreisel::core::bench
