#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/bench/nest_mesh.hpp"
#include "apps/shared/outputs.hpp"
#include "file/write_text.hpp"
#include "nest/accuracy.hpp"
#include "run/build_info.hpp"
#include "solve/interrupt.hpp"

namespace kreisel::bench {
namespace {

nlohmann::json to_json(const nest::Accuracy& found, const NestOptions& options) {
  nlohmann::json out = {{"outer", options.outer},
                        {"inner", options.inner},
                        {"seed", options.seed},
                        {"placements", found.placements},
                        {"nested", found.nested},
                        {"exact_agrees", found.exact_agrees},
                        {"pixels", found.pixels},
                        {"peel_disagrees", found.peel_disagrees},
                        {"errors", nlohmann::json::array()},
                        {"termination", found.placements < options.accuracy ? "interrupted" : "complete"},
                        {"commit", build_info::commit}};
  for (const nest::SampledError& e : found.errors)
    out["errors"].push_back({{"resolution", e.resolution},
                             {"optimistic", e.optimistic},
                             {"pessimistic", e.pessimistic},
                             {"missed", e.missed},
                             {"median", e.median},
                             {"percentile_95", e.most_of},
                             {"largest", e.largest}});
  return out;
}

}  // namespace

int nest_accuracy(const NestOptions& given) {
  NestOptions options = given;
  if (options.inner.empty()) options.inner = options.outer;
  require_writable(options.json_file, "--json");
  device::Device device(options.device);
  const nest::Nesting nesting(nest_mesh(options.outer), nest_mesh(options.inner));
  const nest::Accuracy found =
      nest::compare(device, nesting, options.accuracy, {64, 128, 256, 512}, options.seed, interrupted);
  const std::string text = to_json(found, options).dump(2) + "\n";
  if (options.json_file == "-") {
    fmt::print("{}", text);
  } else {
    if (!options.json_file.empty()) write_text(options.json_file, text);
    fmt::print("{} in {}: {} random placements, {} of which nest at some scale\n", options.inner,
               options.outer, found.placements, found.nested);
    fmt::print("  exact says the same as hybrid, valid there and invalid 1e-4 above: {}\n",
               found.exact_agrees);
    fmt::print("  peeling and envelopes differ in {} of {} pixels\n", found.peel_disagrees, found.pixels);
    fmt::print("  sampled scale less exact scale:\n");
    fmt::print("  {:>10} {:>10} {:>10} {:>10} {:>10} {:>11} {:>8}\n", "resolution", "median", "95 %",
               "largest", "optimistic", "pessimistic", "missed");
    for (const nest::SampledError& e : found.errors)
      fmt::print("  {:>10} {:>10.2g} {:>10.2g} {:>10.2g} {:>10} {:>11} {:>8}\n", e.resolution, e.median,
                 e.most_of, e.largest, e.optimistic, e.pessimistic, e.missed);
  }
  return found.placements < options.accuracy ? was_interrupted : done;
}

}  // namespace kreisel::bench
