// runner.hpp - runs an experiment: what is finished is skipped, what fails is recorded, the rest goes on.
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "experiment/experiment.hpp"
#include "run/nest_run.hpp"
#include "session/orientation_map.hpp"
#include "session/pipeline.hpp"
#include "table/recorded_run.hpp"

namespace kreisel::core {

struct RunnerOptions {
  std::filesystem::path results = "results/runs";  ///< records lie in <results>/<experiment name>/
  bool force = false;                              ///< runs what is finished as well, and replaces its record
  std::FILE* log = stderr;  ///< failures and interruption; on a terminal also progress and a line a run
};

/// What the runner calls; tests put their own in place.
struct RunnerHooks {
  std::function<RunOutput(const RunConfig&, const std::string& mesh_file, const Control&)> run =
      kreisel::core::run;
  std::function<OrientationMap(const MapRun&, const Control&)> map = [](const MapRun& asked,
                                                                        const Control& control) {
    Session session;
    return map_orientations(session, map_spec(asked), control);
  };
  std::function<Simulation(const SimulationRun&, const Control&)> simulation = run_simulation;
  std::function<NestResult(const NestConfig&, const NestHooks&)> nest = run_nest;
  std::stop_token stop = {};
  /// Told, in a line, of what is odd about a run that goes on all the same. Empty: the log is told.
  std::function<void(const ExperimentRun&, const std::string& line)> remark;
  /// Of a run that failed before it could say itself.
  std::function<Provenance(const ExperimentRun&)> provenance;
};

/// What is on disk for one run.
enum class RunState {
  missing,
  failed,        ///< an error is on record; it is run again
  without_mesh,  ///< the record is there, the mesh that the experiment keeps is not; it is run again
  few_samples,   ///< fewer timed solves were asked for than now, and there is time for more; it is run again
  absent,        ///< a mesh file that it names is not here; it is skipped
  finished       ///< whatever its termination: a solver that gave up is a result
};

/// One distinct run of an experiment; runs that differ only in label share it.
struct PlannedRun {
  ExperimentRun run;
  std::filesystem::path record;
  std::filesystem::path mesh;  ///< beside the record, same stem; empty: not kept
  RunState state = RunState::missing;
  std::string lacks = {};  ///< of what is absent, as text_of_absent() says it
};

/// Counts of distinct runs.
struct RunCounts {
  int done = 0;         ///< ran and was recorded
  int unconverged = 0;  ///< of those, neither optimal nor acceptable
  int skipped = 0;      ///< was finished already
  int absent = 0;       ///< skipped, as a mesh file is not here
  int failed = 0;       ///< ended in an error, which was recorded
  bool interrupted = false;
};

/// <results>/<experiment name>/<run_name()>.h5
[[nodiscard]] std::filesystem::path record_path(const std::filesystem::path& results,
                                                const std::string& experiment, const ExperimentRun& run);

/// Every run of the experiment, in the order of the file, with its record under `results`.
/// @throws InputError  a record that cannot be read
[[nodiscard]] std::vector<RecordedRun> collect(const Experiment& experiment,
                                               const std::filesystem::path& results);

/// @param read  what collect() gave, if it was asked: then no record is read again
/// @throws InputError  a record that cannot be read: it may be of a newer version, so it is not replaced
/// unasked
[[nodiscard]] std::vector<PlannedRun> plan_runs(const Experiment& experiment,
                                                const RunnerOptions& options = {},
                                                const std::vector<RecordedRun>* read = nullptr);

/// What run_experiment() would do: a line a run, which names its record, then the counts. Ends with a
/// newline; runs nothing.
[[nodiscard]] std::string dry_run(const Experiment& experiment, const RunnerOptions& options = {});

/// Runs what is not finished, in the order of the file. Every finished run is on disk before the next begins;
/// an interrupted one leaves nothing. What names an absent mesh file is skipped, with a line in the log.
///
/// @param read  as plan_runs() takes it
/// @throws InputError  a record that cannot be read or written
RunCounts run_experiment(const Experiment& experiment, const RunnerOptions& options = {},
                         const RunnerHooks& hooks = {}, const std::vector<RecordedRun>* read = nullptr);

}  // namespace kreisel::core
