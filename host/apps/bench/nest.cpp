#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/bench/commands.hpp"
#include "apps/bench/nest_print.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/step_line.hpp"
#include "body/source.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "nest/search/baseline.hpp"
#include "record/kept_search.hpp"
#include "record/nest_record.hpp"

namespace kreisel::core::bench {
namespace {

/// What a search that goes on may be told anew: nothing that would lead it elsewhere.
bool may_change(const std::string& field) { return field == "seconds" || field == "device"; }

NestCheckpoint resumed(const NestOptions& options) {
  NestCheckpoint checkpoint = read_checkpoint(options.resume_file);
  if (auto* search = part_of<NestSearch>(checkpoint.config)) search->seconds = NestSearch().seconds;
  for (const GivenText& field : options.given) {
    if (!may_change(field.name))
      throw InputError(
          fmt::format("--{} with --resume; expected the options that the search was begun with", field.name));
    set_field(checkpoint.config, field.name, field.text);
  }
  return checkpoint;
}

void print_accuracy(const NestResult& result) {
  const nest::Accuracy& found = *result.accuracy;
  fmt::print("{}: sampled scales less exact ones\n", shapes_text(result.config));
  fmt::print("  placements {}, of which {} nest at some scale\n", found.placements, found.nested);
  fmt::print("  exact      agrees on {} of {}\n", found.exact_agrees, found.nested);
  fmt::print("  peel       differs from envelope in {} of {} pixels\n", found.peel_disagrees, found.pixels);
  fmt::print("  pixels        median     95 %      largest   above   below   missed\n");
  for (const nest::SampledError& e : found.errors)
    fmt::print("  {:>4} x {:<4} {:>9.2g} {:>9.2g} {:>9.2g} {:>9} {:>7} {:>8}\n", e.resolution, e.resolution,
               e.median, e.most_of, e.largest, e.optimistic, e.pessimistic, e.missed);
}

std::string certified_text(const NestResult& result) {
  const nest::CertifiedScale& certified = *result.certified;
  if (certified.confirmed) return fmt::format("valid on the triangles themselves at {:.6g}", certified.scale);
  const std::string no = "no: the exact test says invalid, what was sampled missed a contact";
  return certified.scale > 0 ? fmt::format("{}; repaired: valid at {:.6g}", no, certified.scale) : no;
}

void print(const NestResult& result) {
  if (result.accuracy) return print_accuracy(result);
  if (result.layers) return print_layers(result);
  if (result.landscape) return print_landscape(result);
  const NestConfig& config = result.config;
  const auto* swarm = part_of<NestSearch>(config);
  const NestDecision& by = *part_of<NestDecision>(config);
  fmt::print("{}: {} by {}\n", shapes_text(config),
             swarm                       ? swarm->swarm + " swarm over " + swarm->free
             : part_of<NestTest>(config) ? "feasibility"
                                         : "scale search",
             by.variant);
  fmt::print("  triangles  {} + {}\n", result.outer_triangles, result.inner_triangles);
  if (result.placed) fmt::print("  scale      {:.6g}\n", result.scale);
  fmt::print("  answer     {}\n", result.text);
  if (result.certified) fmt::print("  certified  {}\n", certified_text(result));
  if (result.sampled_scale)
    fmt::print("  sampled    valid by {0} x {0} pixels up to {1:.6g}\n", by.resolution,
               *result.sampled_scale);
  fmt::print(
      "  time       {:.3f} ms test or search ({} evaluations), {:.3f} s set-up, {:.3f} s certification\n",
      1e3 * result.search_seconds, result.evaluations, result.setup_seconds, result.certify_seconds);
  for (const NestTiming& t : result.timings)
    fmt::print("  {:<10} {:.4g} ms a test at 0.98 of it, {:.4g} ms a search, which finds {:.6g}\n", t.variant,
               t.test_ms, t.search_ms, t.scale);
  if (result.ending == NestResult::Ending::out_of_time)
    fmt::print("  ended      after {} s, as asked\n", swarm->seconds);
}

}  // namespace

int nest_shapes(const NestOptions& options) {
  require_writable(options.json_file, "--json");
  require_writable(options.record_file, "--record");
  require_writable(options.checkpoint_file, "--checkpoint");
  NestConfig config;
  NestHooks hooks;
  NestCheckpoint checkpoint;
  if (!options.resume_file.empty()) {
    checkpoint = resumed(options);
    config = checkpoint.config;
    hooks.resume = &checkpoint;
  } else {
    std::vector<std::string_view> names;
    for (const GivenText& field : options.given) names.push_back(field.name);
    config = std::get<NestConfig>(make_run(options.given, kind_of_fields(names, true)));
  }
  require_valid(config);
  for (const std::string& shape : shapes_of(config)) {
    BodySpec spec;
    spec.model = shape;
    require_known_source(spec);
  }
  if (const auto* search = part_of<NestSearch>(config); search && nest::is_baseline(search->swarm))
    throw InputError(fmt::format(
        "swarm = '{}'; expected one of bench's own, the program nest_baseline has those", search->swarm));
  const std::string kept = options.checkpoint_file.empty() ? options.resume_file : options.checkpoint_file;
  if (!kept.empty()) {
    if (!part_of<NestSwarm>(config))
      throw InputError(
          fmt::format("--checkpoint of {}; expected a search over placements, by --free without --layers",
                      entry_of(config).what));
    hooks.keep = [&](const NestCheckpoint& now) { write_checkpoint(kept, now); };
    hooks.exchange = [search = KeptSearch(kept)](const NestCheckpoint& now) {
      search.keep(now);
      return search.better_elsewhere(now);
    };
  }
  if (const auto* swarm = part_of<NestSwarm>(config); swarm && swarm->exchange > 0 && kept.empty())
    throw InputError(
        fmt::format("--exchange {} without --checkpoint; expected a file beside those of the other islands",
                    swarm->exchange));
  NestResult result;
  {
    const StepLine line;
    hooks.control = line.control();
    result = run_nest(config, hooks);
  }
  if (!options.record_file.empty()) write_nest(options.record_file, result);
  const std::string text = to_json(result).dump(2) + "\n";
  if (options.json_file == "-") {
    fmt::print("{}", text);
  } else {
    if (!options.json_file.empty()) write_text(options.json_file, text);
    print(result);
  }
  if (result.ending == NestResult::Ending::interrupted) return was_interrupted;
  return result.accuracy || result.valid ? done : infeasible;
}

}  // namespace kreisel::core::bench
