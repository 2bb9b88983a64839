#include "experiment/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <system_error>

#include "error.hpp"
#include "experiment/progress.hpp"
#include "experiment/run_text.hpp"
#include "record/record.hpp"

namespace kreisel {
namespace fs = std::filesystem;
namespace {

/// Whether more timed solves are asked for than when the record was made, and would be made now. A record
/// that was asked the same is as good as another one would be.
bool wants_more_samples(const RunConfig& config, const RecordSummary& record) {
  double spent = 0;
  for (const Seconds& sample : record.samples) spent += sample.solve;
  return (record.repeat < config.repeat || record.budget_seconds < config.budget_seconds) &&
         record.samples.size() < static_cast<std::size_t>(config.repeat) && spent < config.budget_seconds;
}

RunState state_of(const PlannedRun& run) {
  std::error_code ignored;
  if (!fs::exists(run.record, ignored)) return RunState::missing;
  const RecordSummary record = read_record(run.record);
  if (!record.error.empty()) return RunState::failed;
  if (!run.mesh.empty() && !fs::exists(run.mesh, ignored)) return RunState::without_mesh;
  if (wants_more_samples(run.config, record)) return RunState::few_samples;
  return RunState::finished;
}

std::string_view text_of(RunState state) {
  switch (state) {
    case RunState::missing:
      return "to run";
    case RunState::failed:
      return "to run again, failed";
    case RunState::without_mesh:
      return "to run again, no mesh";
    case RunState::few_samples:
      return "to run again, timed less";
    case RunState::finished:
      return "finished";
  }
  return "";
}

/// A device that cannot be opened is often why the run failed, so its absence is no second error.
Provenance provenance_of(const RunConfig& config) {
  using device::Precision;
  try {
    const device::Device device(config.device,
                                config.single_precision ? Precision::single : Precision::automatic);
    return make_provenance(device);
  } catch (const std::exception&) {
    return {};
  }
}

bool converged(Termination termination) {
  return termination == Termination::optimal || termination == Termination::acceptable;
}

std::string result_text(const RunResult& result, double wall_seconds) {
  const Outcome& outcome = result.outcome;
  return fmt::format("{}: {}, {} variables, {} iterations, {:.3g} s (median of {}), f = {:.6g}; {} in all",
                     run_text(result.config), to_string(outcome.termination), result.variables,
                     outcome.iterations, result.median.solve, result.samples.size(), outcome.objective,
                     duration_text(wall_seconds));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("{}: {}, expected a folder for results", folder.string(), error.message()));
}

/// The mesh is written beside its final name, so that an interrupted or failing run leaves the old one alone.
class MeshInProgress {
 public:
  explicit MeshInProgress(const fs::path& target) : target_(target) {
    if (!target.empty()) partial_ = fs::path(target).replace_extension(".new.stl");
  }
  ~MeshInProgress() {
    std::error_code ignored;
    if (!partial_.empty()) fs::remove(partial_, ignored);
    for (const auto& [from, to] : others_) fs::remove(from, ignored);
  }
  MeshInProgress(const MeshInProgress&) = delete;
  MeshInProgress& operator=(const MeshInProgress&) = delete;

  [[nodiscard]] std::string file() const { return partial_.string(); }

  /// The record names the meshes, one a material, as they will be.
  void name_in(RunResult& result) {
    if (partial_.empty()) return;
    result.verified.file = target_.string();
    for (WrittenMaterial& material : result.verified.materials) {
      const std::string name = material.file.filename().string(), stem = partial_.stem().string();
      const fs::path kept =
          target_.parent_path() / (target_.stem().string() + name.substr(std::min(stem.size(), name.size())));
      if (material.file != partial_) others_.emplace_back(material.file, kept);
      material.file = kept;
    }
  }

  void keep() {
    if (partial_.empty()) return;
    for (const auto& [from, to] : others_) rename(from, to);
    rename(partial_, target_);
    others_.clear();
    partial_.clear();
  }

 private:
  static void rename(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error)
      throw InputError(fmt::format("{}: {}, expected to keep the mesh there", to.string(), error.message()));
  }

  fs::path target_, partial_;
  std::vector<std::pair<fs::path, fs::path>> others_;  ///< of further materials: as written, as kept
};

}  // namespace

fs::path record_path(const fs::path& results, const std::string& experiment, const RunConfig& config) {
  return results / experiment / (run_name(config) + ".h5");
}

std::vector<PlannedRun> plan_runs(const Experiment& experiment, const RunnerOptions& options) {
  std::vector<PlannedRun> plan;
  for (const ExperimentRun& run : experiment.runs) {
    const fs::path record = record_path(options.results, experiment.name, run.config);
    auto known =
        std::find_if(plan.begin(), plan.end(), [&](const auto& other) { return other.record == record; });
    if (known == plan.end()) {
      plan.push_back({run.config, record, {}, {}});
      known = plan.end() - 1;
    }
    if (run.mesh) known->mesh = fs::path(record).replace_extension(".stl");
  }
  // A forced run does not look at what it replaces.
  if (!options.force)
    for (PlannedRun& run : plan) run.state = state_of(run);
  return plan;
}

std::string dry_run(const Experiment& experiment, const RunnerOptions& options) {
  const auto plan = plan_runs(experiment, options);
  std::string text;
  std::size_t finished = 0;
  for (const PlannedRun& run : plan) {
    if (run.state == RunState::finished) ++finished;
    text +=
        fmt::format("{:<24}  {:<40}  {}\n", text_of(run.state), run_text(run.config), run.record.string());
  }
  text += fmt::format("{}: {} to run, {} finished\n", experiment.name, plan.size() - finished, finished);
  return text;
}

RunCounts run_experiment(const Experiment& experiment, const RunnerOptions& options,
                         const RunnerHooks& hooks) {
  RunCounts counts;
  std::vector<PlannedRun> pending;
  std::vector<RunConfig> configs;
  for (PlannedRun& run : plan_runs(experiment, options)) {
    if (run.state == RunState::finished) {
      ++counts.skipped;
      continue;
    }
    configs.push_back(run.config);
    pending.push_back(std::move(run));
  }
  if (!pending.empty()) make_folder(options.results / experiment.name);

  ProgressLine progress(options.log, std::move(configs));
  for (std::size_t i = 0; i < pending.size() && !counts.interrupted; ++i) {
    const PlannedRun& run = pending[i];
    if (hooks.interrupted()) {
      counts.interrupted = true;
      break;
    }
    MeshInProgress mesh(run.mesh);
    std::optional<RunResult> result;
    std::string error;
    progress.begin(i);
    try {
      result =
          hooks.run(run.config, mesh.file(), [&](const std::string& step) { progress.step(step); }).result;
    } catch (const std::bad_alloc&) {
      error = "not enough memory; expected a coarser resolution";
    } catch (const std::exception& e) {
      error = e.what();
    } catch (...) {  // Ipopt's own are no std::exception
      error = "unknown exception";
    }
    const double seconds = progress.end(result.has_value());

    // Interrupted between two timed solves: whole, but timed less often than asked.
    const bool cut_short =
        result && result->samples.size() < static_cast<std::size_t>(run.config.repeat) && hooks.interrupted();
    if (result && !cut_short && result->outcome.termination != Termination::interrupted) {
      mesh.name_in(*result);
      write_record(run.record, *result);  // may find the disk full: then the old mesh stays, too
      mesh.keep();
      ++counts.done;
      if (!converged(result->outcome.termination)) ++counts.unconverged;
      progress.note(result_text(*result, seconds));
    } else if (result || hooks.interrupted()) {
      // What an interruption tore apart says nothing about the run.
      counts.interrupted = true;
    } else {
      write_failure(run.record, run.config,
                    hooks.provenance ? hooks.provenance(run.config) : provenance_of(run.config), error);
      ++counts.failed;
      fmt::print(options.log, "{}: failed: {}\n", run_text(run.config), error);
      std::fflush(options.log);
    }
  }
  if (counts.interrupted) {
    const auto left = pending.size() - static_cast<std::size_t>(counts.done + counts.failed);
    fmt::print(options.log, "{}: interrupted, {} of {} runs left; what is done is kept\n", experiment.name,
               left, pending.size());
    std::fflush(options.log);
  }
  return counts;
}

}  // namespace kreisel
