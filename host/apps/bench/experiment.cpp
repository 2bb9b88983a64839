#include "experiment/experiment.hpp"

#include <fmt/format.h>

#include "apps/bench/commands.hpp"
#include "experiment/runner.hpp"
#include "experiment/table.hpp"
#include "record/record.hpp"

namespace kreisel::bench {

int run_experiment(const ExperimentOptions& options) {
  Experiment experiment = read_experiment(find_experiment(options.name));
  if (!options.device.empty())
    for (ExperimentRun& run : experiment.runs) set_field(run.config, "device", options.device);

  RunnerOptions runner;
  runner.results = options.results;
  runner.force = options.force;
  if (options.dry_run) {
    fmt::print("{}", dry_run(experiment, runner));
    return done;
  }
  const RunCounts counts = kreisel::run_experiment(experiment, runner);

  const std::vector<RecordedRun> runs = collect(experiment, runner.results);
  fmt::print("{}", table_text(experiment, runs));
  if (!options.csv_file.empty()) write_text(options.csv_file, table_csv(experiment, runs));
  fmt::print("\n{} runs done, {} finished before, {} failed; records in {}/{}\n", counts.done, counts.skipped,
             counts.failed, options.results, experiment.name);
  if (counts.interrupted) return was_interrupted;
  return counts.failed + counts.unconverged > 0 ? not_converged : done;
}

}  // namespace kreisel::bench
