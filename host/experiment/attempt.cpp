#include "experiment/attempt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "error.hpp"
#include "experiment/child.hpp"
#include "experiment/outside_nesting.hpp"
#include "experiment/outside_solve.hpp"
#include "nest/search/baseline.hpp"
#include "record/kept_search.hpp"
#include "record/map_record.hpp"
#include "record/nest_record.hpp"
#include "record/record.hpp"
#include "record/records_in.hpp"
#include "record/simulation_record.hpp"
#include "table/experiment_run.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;
namespace {

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

class Solve final : public Attempt {
 public:
  Solve(const PlannedRun& run, const RunnerHooks& hooks) : run_(run), hooks_(hooks), mesh_(run.mesh) {}

  void run(const Control& control) override {
    result_ = hooks_.run(run_.run.solve(), mesh_.file(), control).result;
    // Interrupted between two timed solves: whole, but timed less often than asked.
    const bool cut_short = result_->samples.size() < static_cast<std::size_t>(run_.run.solve().repeat) &&
                           hooks_.stop.stop_requested();
    whole_ = !cut_short && result_->outcome.termination != Termination::interrupted;
  }

  [[nodiscard]] bool whole() const override { return whole_; }
  [[nodiscard]] bool converged() const override {
    const Termination termination = result_->outcome.termination;
    return termination == Termination::optimal || termination == Termination::acceptable;
  }
  [[nodiscard]] std::string text() const override {
    const Outcome& outcome = result_->outcome;
    return fmt::format("{}: {}, {} variables, {} iterations, {:.3g} s (median of {}), f = {:.6g}",
                       run_text(run_.run), to_string(outcome.termination), result_->variables,
                       outcome.iterations, result_->median.solve, result_->samples.size(), outcome.objective);
  }
  void keep() override {
    mesh_.name_in(*result_);
    write_record(run_.record, *result_);  // may find the disk full: then the old mesh stays, too
    mesh_.keep();
  }

 private:
  const PlannedRun& run_;
  const RunnerHooks& hooks_;
  MeshInProgress mesh_;
  std::optional<RunResult> result_;
  bool whole_ = false;
};

class Mapping final : public Attempt {
 public:
  Mapping(const PlannedRun& run, const RunnerHooks& hooks) : run_(run), hooks_(hooks) {}

  void run(const Control& control) override { map_ = hooks_.map(std::get<MapRun>(*run_.run.run), control); }
  [[nodiscard]] bool whole() const override { return map_.axes.size() == map_.asked; }
  [[nodiscard]] bool converged() const override { return true; }  // an axis that is infeasible is an answer
  [[nodiscard]] std::string text() const override {
    std::size_t feasible = 0;
    for (std::size_t c = 0; c < map_.cases.size(); ++c) feasible += map_.count(c, MapAnswer::feasible);
    return fmt::format("{}: {} axes, {:.3g} s, {} of {} feasible", run_text(run_.run), map_.axes.size(),
                       map_.sweep_seconds, feasible, map_.answers.size());
  }
  void keep() override { write_map(run_.record, map_); }

 private:
  const PlannedRun& run_;
  const RunnerHooks& hooks_;
  OrientationMap map_;
};

class Nesting final : public Attempt {
 public:
  Nesting(const PlannedRun& run, const RunnerHooks& hooks) : run_(run), hooks_(hooks) {}

  void run(const Control& control) override {
    const NestConfig& config = run_.run.nesting();
    NestHooks hooks;
    hooks.control = control;
    if (const auto* swarm = part_of<NestSwarm>(config)) {
      kept_.emplace(checkpoint_of(run_.record, config));
      islands_ = swarm->exchange > 0;
      hooks.keep = [this](const NestCheckpoint& now) { kept_->keep(now); };
      hooks.exchange = [this](const NestCheckpoint& now) {
        kept_->keep(now);
        return kept_->better_elsewhere(now);
      };
    }
    if (const std::optional<NestCheckpoint> begun = kept_ ? begun_of(config) : std::nullopt) try {
        hooks.resume = &*begun;
        result_ = hooks_.nest(config, hooks);
        return;
      } catch (const nest::UnfitState& damaged) {
        say_anew(damaged);
        hooks.resume = nullptr;
      }
    result_ = hooks_.nest(config, hooks);
  }
  [[nodiscard]] bool whole() const override { return result_.ending != NestResult::Ending::interrupted; }
  [[nodiscard]] bool converged() const override { return true; }  // that nothing nests is an answer
  [[nodiscard]] std::string text() const override {
    return fmt::format("{}: {}, scale {:.4f}, {} evaluations, {:.3g} s", run_text(run_.run),
                       termination_of(result_), result_.scale, result_.evaluations, result_.search_seconds);
  }
  void keep() override {
    write_nest(run_.record, result_);
    if (kept_ && !islands_) kept_->remove();  // what an island found is for the others, too
  }

 private:
  /// What is kept of the search; nothing where that is damaged.
  [[nodiscard]] std::optional<NestCheckpoint> begun_of(const NestConfig& config) const {
    try {
      return kept_->begun(config);
    } catch (const InputError& damaged) {
      say_anew(damaged);
      return std::nullopt;
    }
  }
  /// A file may be torn; that is no reason to give up what was asked for.
  void say_anew(const InputError& damaged) const {
    if (hooks_.remark)
      hooks_.remark(run_.run, fmt::format("begins anew, its checkpoint is damaged: {}", damaged.what()));
  }

  const PlannedRun& run_;
  const RunnerHooks& hooks_;
  NestResult result_;
  std::optional<KeptSearch> kept_;  ///< of a search that can go on from where it was
  bool islands_ = false;
};

class Simulating final : public Attempt {
 public:
  Simulating(const PlannedRun& run, const RunnerHooks& hooks) : run_(run), hooks_(hooks) {}

  void run(const Control& control) override {
    result_ = hooks_.simulation(std::get<SimulationRun>(*run_.run.run), control);
  }
  [[nodiscard]] bool whole() const override { return true; }      // one that is interrupted throws
  [[nodiscard]] bool converged() const override { return true; }  // that there is no part is an answer
  [[nodiscard]] std::string text() const override {
    if (!result_.made) return fmt::format("{}: {}, no part", run_text(run_.run), result_.termination);
    return fmt::format("{}: {}", run_text(run_.run), result_.part.verdict.text);
  }
  void keep() override { write_simulation(run_.record, result_); }

 private:
  const PlannedRun& run_;
  const RunnerHooks& hooks_;
  Simulation result_;
};

/// Whether more timed solves are asked for than when the record was made, and would be made now. A record
/// that was asked the same is as good as another one would be.
bool wants_more_samples(const RunConfig& config, const fs::path& record) {
  if (config.repeat <= 1) return false;  // each is timed once
  const RunResult made = read_timing(record);
  double spent = 0;
  for (const Seconds& sample : made.samples) spent += sample.solve;
  return (made.config.repeat < config.repeat || made.config.budget_seconds < config.budget_seconds) &&
         made.samples.size() < static_cast<std::size_t>(config.repeat) && spent < config.budget_seconds;
}

RunState state_by(const Standing& standing, const PlannedRun& run) {
  if (is_limit(limits_of(run.run), standing.error)) return RunState::finished;
  if (!standing.error.empty()) return RunState::failed;
  if (!standing.complete) return RunState::missing;
  if (standing.kind != RecordKind::run) return RunState::finished;
  std::error_code ignored;
  if (!run.mesh.empty() && !fs::exists(run.mesh, ignored)) return RunState::without_mesh;
  if (wants_more_samples(run.run.solve(), run.record)) return RunState::few_samples;
  return RunState::finished;
}

}  // namespace

std::unique_ptr<Attempt> make_attempt(const PlannedRun& run, const RunnerHooks& hooks) {
  struct Make {
    const PlannedRun& run;
    const RunnerHooks& hooks;
    std::unique_ptr<Attempt> operator()(const RunConfig& solve) const {
      if (solve.limits.any()) return std::make_unique<OutsideSolve>(run);
      return std::make_unique<Solve>(run, hooks);
    }
    std::unique_ptr<Attempt> operator()(const MapRun&) const { return std::make_unique<Mapping>(run, hooks); }
    std::unique_ptr<Attempt> operator()(const SimulationRun&) const {
      return std::make_unique<Simulating>(run, hooks);
    }
    std::unique_ptr<Attempt> operator()(const NestConfig& nest) const {
      const auto* search = part_of<NestSearch>(nest);
      if (search && nest::is_baseline(search->swarm)) return std::make_unique<OutsideNesting>(run);
      return std::make_unique<Nesting>(run, hooks);
    }
  };
  return std::visit(Make{run, hooks}, *run.run.run);
}

OnRecord on_record(const PlannedRun& run) {
  std::error_code ignored;
  if (!fs::exists(run.record, ignored)) return {};
  const Standing standing = standing_of_record(run.record);
  return {state_by(standing, run), standing.host};
}

OnRecord on_record(const PlannedRun& run, const std::optional<Record>& record) {
  if (!record) return {};
  const Standing standing = standing_of(*record);
  return {state_by(standing, run), standing.host};
}

}  // namespace kreisel::core
