#include "experiment/experiment.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>

#include "apps/bench/commands.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/program.hpp"
#include "body/source.hpp"
#include "error.hpp"
#include "experiment/experiment_table.hpp"
#include "experiment/runner.hpp"
#include "experiment/shard.hpp"
#include "record/record.hpp"
#include "table/data_folder.hpp"

namespace kreisel::core::bench {
namespace {

void require_shapes(const ExperimentRun& run) {
  if (const Asked* asked = asked_of(run.run)) return require_known_source(asked->body);
  for (const std::string& shape : shapes_of(run.run)) {
    BodySpec spec;
    spec.model = shape;
    require_known_source(spec);
  }
}

/// Before hours of work: names of models and files that are looked up in the course of it or after it.
void require_names(const Experiment& experiment) {
  try {
    for (const ExperimentRun& run : experiment.runs) require_shapes(run);
    if (!experiment.published.empty()) (void)published_file(experiment.published);
    for (const std::string& figure : experiment.figures) (void)figure_file(figure);
  } catch (const InputError& error) {
    throw InputError(fmt::format("experiment {}: {}", experiment.name, error.what()));
  }
}

/// Whoever reads a mesh looks there, programs that are called included.
void look_for_files_in(const std::string& folder) {
  if (folder.empty()) return;
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw InputError(fmt::format("--models {}: no such folder; expected one with mesh files", folder));
  ::setenv("KREISEL_MODELS", folder.c_str(), 1);
}

}  // namespace

Experiment experiment_of(const std::string& name) {
  Experiment experiment = read_experiment(find_experiment(name));
  require_names(experiment);
  return experiment;
}

int run_experiment(const ExperimentOptions& options) {
  Experiment experiment = experiment_of(options.name);
  look_for_files_in(options.models);
  if (!options.csv_file.empty()) require_writable(options.csv_file, "--csv");
  if (!options.device.empty())
    for (ExperimentRun& run : experiment.runs) set_field(run.run.changed(), "device", options.device);

  const bool whole = options.shard.empty();
  if (!whole) experiment = share_of(experiment, shard_of(options.shard));

  RunnerOptions runner;
  runner.results = options.results;
  runner.force = options.force;
  if (options.dry_run) {
    fmt::print("{}", dry_run(experiment, runner));
    return done;
  }
  RunnerHooks hooks;
  hooks.stop = interruption();
  // What a table is made of tells what is finished, too: where there is nothing to run, records are read
  // once.
  const bool tabled = whole || !options.csv_file.empty(), read_first = tabled && !options.force;
  std::vector<RecordedRun> runs;
  if (read_first) runs = collect(experiment, runner.results);
  const RunCounts counts =
      kreisel::core::run_experiment(experiment, runner, hooks, read_first ? &runs : nullptr);

  if (tabled) {
    if (!read_first || counts.done + counts.failed > 0) runs = collect(experiment, runner.results);
    if (whole) fmt::print("{}\n", table_text(experiment, runs));
    if (!options.csv_file.empty()) write_text(options.csv_file, table_csv(experiment, runs));
  }
  fmt::print("{}{} runs done, {} finished before, {} failed{}; records in {}/{}\n",
             whole ? "" : fmt::format("shard {}: ", options.shard), counts.done, counts.skipped,
             counts.failed,
             counts.absent > 0 ? fmt::format(", {} skipped for want of a file", counts.absent) : "",
             options.results, experiment.name);
  if (counts.interrupted) return was_interrupted;
  return counts.failed + counts.unconverged > 0 ? not_converged : done;
}

}  // namespace kreisel::core::bench
