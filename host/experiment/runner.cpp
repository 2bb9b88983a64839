#include "experiment/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <unordered_map>

#include "error.hpp"
#include "experiment/absent_files.hpp"
#include "experiment/attempt.hpp"
#include "experiment/progress.hpp"
#include "record/record.hpp"
#include "table/experiment_run.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;
namespace {

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
    case RunState::absent:
      return "skipped, no mesh file";
    case RunState::finished:
      return "finished";
  }
  return "";
}

/// A device that cannot be opened is often why the run failed, so its absence is no second error.
Provenance provenance_of(const ExperimentRun& run) {
  using device::Precision;
  try {
    const device::Device device(text_of(run.run, "device"), text_of(run.run, "precision") == "single"
                                                                ? Precision::single
                                                                : Precision::automatic);
    return make_provenance(device);
  } catch (const std::exception&) {
    return {};
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("{}: {}, expected a folder for results", folder.string(), error.message()));
}

}  // namespace

fs::path record_path(const fs::path& results, const std::string& experiment, const ExperimentRun& run) {
  return results / experiment / (run_name(run.run) + ".h5");
}

std::vector<RecordedRun> collect(const Experiment& experiment, const std::filesystem::path& results) {
  std::vector<RecordedRun> runs;
  for (const ExperimentRun& run : experiment.runs) {
    const auto path = record_path(results, experiment.name, run);
    std::error_code ignored;
    RecordedRun& recorded = runs.emplace_back(RecordedRun{run});
    if (std::filesystem::exists(path, ignored)) recorded.record = read_record(path);
  }
  return runs;
}

std::vector<PlannedRun> plan_runs(const Experiment& experiment, const RunnerOptions& options,
                                  const std::vector<RecordedRun>* read) {
  std::vector<PlannedRun> plan;
  std::vector<std::size_t> first;  // of the experiment's runs with that record
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < experiment.runs.size(); ++i) {
    const ExperimentRun& run = experiment.runs[i];
    const fs::path record = record_path(options.results, experiment.name, run);
    const auto [at, is_new] = known.try_emplace(record.string(), plan.size());
    if (is_new) {
      plan.push_back({run, record, {}, {}});
      first.push_back(i);
    }
    if (run.mesh) plan[at->second].mesh = fs::path(record).replace_extension(".stl");
  }
  // A forced run does not look at what it replaces.
  if (!options.force)
    for (std::size_t i = 0; i < plan.size(); ++i)
      plan[i].state = (read ? on_record(plan[i], read->at(first[i]).record) : on_record(plan[i])).state;
  for (PlannedRun& run : plan) {
    if (run.state == RunState::finished) continue;
    run.lacks = text_of_absent(run.run);
    if (!run.lacks.empty()) run.state = RunState::absent;
  }
  return plan;
}

std::string dry_run(const Experiment& experiment, const RunnerOptions& options) {
  const auto plan = plan_runs(experiment, options);
  std::string text;
  std::size_t finished = 0, absent = 0;
  for (const PlannedRun& run : plan) {
    if (run.state == RunState::finished) ++finished;
    if (run.state == RunState::absent) ++absent;
    text += fmt::format("{:<24}  {:<40}  {}{}\n", text_of(run.state), run_text(run.run), run.record.string(),
                        run.lacks.empty() ? "" : ": " + run.lacks);
  }
  text += fmt::format("{}: {} to run, {} finished{}\n", experiment.name, plan.size() - finished - absent,
                      finished, absent > 0 ? fmt::format(", {} skipped", absent) : "");
  return text;
}

RunCounts run_experiment(const Experiment& experiment, const RunnerOptions& options, const RunnerHooks& given,
                         const std::vector<RecordedRun>* read) {
  RunCounts counts;
  RunnerHooks hooks = given;
  std::vector<PlannedRun> pending;
  std::vector<Effort> efforts;
  for (PlannedRun& run : plan_runs(experiment, options, read)) {
    if (run.state == RunState::finished) {
      ++counts.skipped;
      continue;
    }
    if (run.state == RunState::absent) {
      ++counts.absent;
      fmt::print(options.log, "{}: skipped: {}\n", run_text(run.run), run.lacks);
      continue;
    }
    efforts.push_back(effort_of(run.run));
    pending.push_back(std::move(run));
  }
  if (!pending.empty()) make_folder(options.results / experiment.name);

  ProgressLine progress(options.log, std::move(efforts));
  if (!hooks.remark)
    hooks.remark = [&](const ExperimentRun& run, const std::string& line) {
      progress.tell(fmt::format("{}: {}", run_text(run), line));
    };
  for (std::size_t i = 0; i < pending.size() && !counts.interrupted; ++i) {
    const PlannedRun& run = pending[i];
    if (hooks.stop.stop_requested()) {
      counts.interrupted = true;
      break;
    }
    const std::unique_ptr<Attempt> attempt = make_attempt(run, hooks);
    std::string error;
    bool ended = false;
    progress.begin(i);
    try {
      attempt->run({hooks.stop, [&](const std::string& step) { progress.step(step); }});
      ended = true;
    } catch (const std::bad_alloc&) {
      error = "not enough memory; expected a coarser resolution";
    } catch (const std::exception& e) {
      error = e.what();
    } catch (...) {  // Ipopt's own are no std::exception
      error = "unknown exception";
    }
    const double seconds = progress.end(ended);

    if (ended && attempt->whole()) {
      attempt->keep();
      ++counts.done;
      if (!attempt->converged()) ++counts.unconverged;
      progress.note(fmt::format("{}; {} in all", attempt->text(), duration_text(seconds)));
    } else if (ended || hooks.stop.stop_requested()) {
      // What an interruption tore apart says nothing about the run.
      counts.interrupted = true;
    } else {
      const Provenance provenance = hooks.provenance ? hooks.provenance(run.run) : provenance_of(run.run);
      write_failure(run.record, run.run.run, provenance, error);
      ++counts.failed;
      fmt::print(options.log, "{}: failed: {}\n", run_text(run.run), error);
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

}  // namespace kreisel::core
