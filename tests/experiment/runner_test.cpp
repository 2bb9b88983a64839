#include "experiment/runner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <memory>
#include <new>
#include <stdexcept>

#include "error.hpp"
#include "experiment/experiment_table.hpp"
#include "experiment/progress.hpp"
#include "experiment/recorded_runs.hpp"
#include "record/map_record.hpp"
#include "record/record.hpp"
#include "record/records_in.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

/// A result with enough in it to be recorded.
RunResult finished(const RunConfig& config, Termination termination = Termination::optimal) {
  RunResult result;
  result.config = config;
  result.variables = 2;
  result.grid = {{4, 3, 2}, Vec3::Zero(), 0.1};
  result.intervals = {{1, 1, 0, 2}};
  result.rays = 1;
  result.outcome.termination = termination;
  result.outcome.x = {0.5, 1};
  result.outcome.iterations = 7;
  result.outcome.objective = 0.75;
  result.samples = {{0.1, 0.2, 0.3, 0.4}};
  result.median = result.samples.front();
  return result;
}

/// Two grids, two formulations, and a run function that only writes down what it was asked for.
class Runner : public testing::Test {
 protected:
  Runner() {
    options.results = folder.path / "runs";
    options.log = log.get();
    hooks.run = [this](const RunConfig& config, const std::string& mesh, const Control& control) {
      ran.push_back(run_name(config));
      control.tell("solve");
      if (!mesh.empty()) std::ofstream(mesh) << "solid";
      return RunOutput{finished(config), {}, {}};
    };
    hooks.provenance = [](const ExperimentRun&) { return Provenance{}; };
  }

  RunCounts run() { return run_experiment(experiment, options, hooks); }
  fs::path record(std::size_t i) const {
    return record_path(options.results, experiment.name, experiment.runs[i]);
  }
  std::string logged() const {
    std::string text(4096, '\0');
    std::rewind(log.get());
    text.resize(std::fread(text.data(), 1, text.size(), log.get()));
    return text;
  }
  /// Makes the i-th run throw, or end as `error` says.
  template <class Act>
  void when(std::size_t i, Act act) {
    hooks.run = [this, i, act, usual = hooks.run](const RunConfig& config, const std::string& mesh,
                                                  const Control& control) {
      RunOutput output = usual(config, mesh, control);
      if (run_name(config) == run_name(experiment.runs[i].run)) act(output.result);
      return output;
    };
  }

  TemporaryFolder folder;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> log{std::tmpfile(), std::fclose};
  Experiment experiment = parse_experiment(
      "[[run]]\nresolution = [32, '4x3x2']\nformulation = ['rayrep', 'voxel']", "trial.toml");
  RunnerOptions options;
  RunnerHooks hooks;
  std::vector<std::string> ran;
};

TEST_F(Runner, RecordsEveryRunUnderItsNameInTheFolderOfTheExperiment) {
  const RunCounts counts = run();
  EXPECT_EQ(counts.done, 4);
  EXPECT_EQ(counts.skipped + counts.failed + counts.unconverged, 0);
  EXPECT_FALSE(counts.interrupted);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(record(i), folder.path / "runs" / "trial" / (run_name(experiment.runs[i].run) + ".h5"));
    EXPECT_EQ(read_run(record(i)).outcome.objective, 0.75);
  }
  EXPECT_EQ(logged(), "");  // not a terminal
}

TEST_F(Runner, SkipsWhatIsFinishedAndRunsItAgainWhenForced) {
  write_record(record(1), finished(experiment.runs[1].solve()));
  RunCounts counts = run();
  EXPECT_EQ(counts.done, 3);
  EXPECT_EQ(counts.skipped, 1);
  EXPECT_EQ(ran.size(), 3u);
  EXPECT_EQ(run().skipped, 4);
  options.force = true;
  counts = run();
  EXPECT_EQ(counts.done, 4);
  EXPECT_EQ(counts.skipped, 0);
}

TEST_F(Runner, RunsOnceWhatTwoLabelsShare) {
  experiment.runs.push_back(experiment.runs[0]);
  experiment.runs.back().label = "again";
  options.force = true;
  EXPECT_EQ(run().done, 4);
}

TEST_F(Runner, RecordsAFailureGoesOnAndTriesItAgainNextTime) {
  when(1, [](RunResult&) { throw std::bad_alloc(); });
  when(2, [](RunResult&) { throw InputError("no interior left; expected a thinner wall"); });
  const RunCounts counts = run();
  EXPECT_EQ(counts.done, 2);
  EXPECT_EQ(counts.failed, 2);
  EXPECT_EQ(read_record(record(2)).error, "no interior left; expected a thinner wall");
  EXPECT_NE(logged().find("no interior left"), std::string::npos);
  EXPECT_NE(dry_run(experiment, options).find("to run again, failed"), std::string::npos);

  ran.clear();
  EXPECT_EQ(run().skipped, 2);
  EXPECT_EQ(ran.size(), 2u);
}

TEST_F(Runner, RecordsWhatIsThrownThatIsNoStandardException) {
  when(0, [](RunResult&) { throw 1; });
  EXPECT_EQ(run().failed, 1);
  EXPECT_EQ(read_record(record(0)).error, "unknown exception");
}

TEST_F(Runner, KeepsTheResultOfASolverThatGaveUp) {
  when(0, [](RunResult& result) { result.outcome.termination = Termination::infeasible; });
  const RunCounts counts = run();
  EXPECT_EQ(counts.done, 4);
  EXPECT_EQ(counts.unconverged, 1);
  EXPECT_EQ(run().skipped, 4);
}

TEST_F(Runner, StopsAtAnInterruptedRunKeepingWhatIsDone) {
  experiment.runs[1].mesh = true;
  when(1, [](RunResult& result) { result.outcome.termination = Termination::interrupted; });
  const RunCounts counts = run();
  EXPECT_TRUE(counts.interrupted);
  EXPECT_EQ(counts.done, 1);
  EXPECT_TRUE(fs::exists(record(0)));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path / "runs" / "trial"), {}), 1);
  EXPECT_NE(logged().find("interrupted, 3 of 4 runs left"), std::string::npos) << logged();
}

TEST_F(Runner, DoesNotBlameARunThatThrewWhenInterrupted) {
  std::stop_source stop;
  hooks.stop = stop.get_token();
  when(1, [&](RunResult&) {
    stop.request_stop();
    throw std::runtime_error("torn apart");
  });
  const RunCounts counts = run();
  EXPECT_TRUE(counts.interrupted);
  EXPECT_EQ(counts.failed, 0);
  EXPECT_FALSE(fs::exists(record(1)));
}

TEST_F(Runner, StartsNothingOnceInterrupted) {
  std::stop_source stop;
  hooks.stop = stop.get_token();
  stop.request_stop();
  EXPECT_TRUE(run().interrupted);
  EXPECT_TRUE(ran.empty());
}

TEST_F(Runner, PutsTheMeshBesideTheRecordAndMakesItAgainWhenItIsGone) {
  experiment.runs[2].mesh = true;
  EXPECT_EQ(run().done, 4);
  const fs::path mesh = fs::path(record(2)).replace_extension(".stl");
  EXPECT_TRUE(fs::exists(mesh));
  EXPECT_EQ(std::distance(fs::directory_iterator(mesh.parent_path()), {}), 5);
  fs::remove(mesh);
  EXPECT_NE(dry_run(experiment, options).find("to run again, no mesh"), std::string::npos);
  const RunCounts counts = run();
  EXPECT_EQ(counts.done, 1);
  EXPECT_EQ(counts.skipped, 3);
  EXPECT_TRUE(fs::exists(mesh));
}

TEST_F(Runner, AFailingRunLeavesTheOldMeshAlone) {
  experiment.runs[0].mesh = true;
  run();
  options.force = true;
  when(0, [](RunResult&) { throw std::runtime_error("broken"); });
  run();
  EXPECT_TRUE(fs::exists(fs::path(record(0)).replace_extension(".stl")));
  EXPECT_FALSE(fs::exists(fs::path(record(0)).replace_extension(".new.stl")));
}

TEST_F(Runner, ADryRunListsWhatIsFinishedAndRunsNothing) {
  write_record(record(1), finished(experiment.runs[1].solve()));
  const std::string text = dry_run(experiment, options);
  EXPECT_TRUE(ran.empty());
  EXPECT_EQ(text.find("to run "), 0u) << text;
  EXPECT_NE(text.find("\nfinished "), std::string::npos) << text;
  EXPECT_NE(text.find("ellipsoid 4x3x2 voxel ipopt"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("trial: 3 to run, 1 finished\n")) << text;
}

TEST_F(Runner, RefusesToReplaceWhatItCannotRead) {
  folder.write("runs/trial/" + record(0).filename().string(), "not a record");
  EXPECT_THROW((void)run(), InputError);
  EXPECT_TRUE(ran.empty());
}

/// Maps of two axes, of which `answered` were: the first feasible, the second not.
OrientationMap two_axes(const MapRun& config, std::size_t answered = 2) {
  OrientationMap map;
  map.config = config;
  map.body_name = "ellipsoid";
  map.through = config.through;
  map.cases = {""};
  map.asked = 2;
  map.axes = {Vec3::UnitX(), Vec3::UnitZ()};
  map.axes.resize(answered);
  map.contacts.assign(answered, Vec3::Zero());
  map.answers.resize(answered);
  if (answered > 0) {
    map.answers[0].status = MapAnswer::feasible;
    map.answers[0].objective = 0.75;
    map.answers[0].verdict = {true, "spins", {{"omega_min_rpm", 400}}};
  }
  if (answered > 1) map.answers[1].status = MapAnswer::infeasible;
  map.sweep_seconds = 1.5;
  map.grid = {{4, 3, 2}, Vec3::Zero(), 0.1};
  map.rays = 9;
  return map;
}

TEST_F(Runner, RecordsMapsSkipsThemAndSetsThemOutInATable) {
  experiment =
      parse_experiment("table = 'maps'\n[[run]]\nthrough = ['lowest', 'centre']\naxes = 2", "trial.toml");
  int maps = 0;
  hooks.map = [&](const MapRun& config, const Control&) {
    if (++maps == 2) throw InputError("no interior left; expected a thinner wall");
    return two_axes(config);
  };
  RunCounts counts = run();
  EXPECT_EQ(counts.done, 1);
  EXPECT_EQ(counts.failed, 1);
  EXPECT_TRUE(ran.empty());
  EXPECT_EQ(kind_of_record(record(0)), RecordKind::map);
  const OrientationMap map = read_map(record(0));
  EXPECT_EQ(map.axes.size(), 2u);
  EXPECT_EQ(map.count(0, MapAnswer::feasible), 1u);
  const auto best = map.best();
  ASSERT_TRUE(best);
  EXPECT_EQ(map.axes.at(best->axis), Vec3::UnitX());
  EXPECT_EQ(map.at(best->axis, 0).verdict.values.at("omega_min_rpm"), 400);

  const std::string text = table_text(experiment, collect(experiment, options.results));
  EXPECT_EQ(squeezed_line(text, "ellipsoid  spin     lowest"),
            "ellipsoid spin lowest - 4x3x2 9 2 1.50 | 50.0 0.0 50.0 | 1.000,0.000,0.000 0.75 400 -")
      << text;
  EXPECT_NE(text.find("error - no interior left"), std::string::npos) << text;

  counts = run();  // what failed is run again, what is finished is not
  EXPECT_EQ(counts.done, 1);
  EXPECT_EQ(counts.skipped, 1);
  EXPECT_EQ(run().skipped, 2);
}

TEST_F(Runner, LeavesNoRecordOfAMapThatTheUserStopped) {
  experiment = parse_experiment("table = 'maps'\n[[run]]\naxes = 2", "trial.toml");
  hooks.map = [](const MapRun& config, const Control&) { return two_axes(config, 1); };
  const RunCounts counts = run();
  EXPECT_TRUE(counts.interrupted);
  EXPECT_EQ(counts.done, 0);
  EXPECT_FALSE(fs::exists(record(0)));
}

TEST(Estimate, GrowsWithTheNumberOfCellsOfTheSameFormulation) {
  ExperimentRun small_run, large_run, voxel_run;
  small_run.asked().grid.cells = {40, 26, 26};
  large_run.asked().grid.cells = {80, 52, 52};
  voxel_run.asked().grid.cells = {40, 26, 26};
  voxel_run.asked().formulation = "voxel";
  const Effort small = effort_of(small_run), large = effort_of(large_run), voxel = effort_of(voxel_run);
  Estimate estimate;
  EXPECT_FALSE(estimate.seconds(large));
  estimate.finished(small, 2);
  EXPECT_NEAR(estimate.seconds(large).value(), 2 * std::pow(8, 1.2), 1e-9);
  EXPECT_NEAR(estimate.seconds(voxel).value(), 2, 1e-9);  // nothing better is known
  estimate.finished(voxel, 30);
  EXPECT_NEAR(estimate.seconds(voxel).value(), 30, 1e-9);
  EXPECT_NEAR(estimate.seconds(small).value(), 2, 1e-9);
}

TEST(Estimate, WritesDurationsInTheUnitThatFits) {
  EXPECT_EQ(duration_text(0.2), "0 s");
  EXPECT_EQ(duration_text(99), "99 s");
  EXPECT_EQ(duration_text(185), "3 min");
  EXPECT_EQ(duration_text(7500), "2 h 05 min");
}

TEST_F(Runner, RunsAgainWhatWasTimedLessOftenThanAskedNow) {
  run();
  ran.clear();
  for (auto& planned : experiment.runs) planned.solve().repeat = 3;
  EXPECT_EQ(plan_runs(experiment, options)[0].state, RunState::few_samples);
  when(0, [](RunResult& result) { result.samples.assign(3, result.samples.front()); });
  run();
  EXPECT_EQ(ran.size(), experiment.runs.size());
  ran.clear();
  // The first now has three samples; the others were asked for three and gave one, so they would again.
  run();
  EXPECT_EQ(ran, std::vector<std::string>{});
  // Less is asked: three samples are more than enough.
  for (auto& planned : experiment.runs) planned.solve().repeat = 2;
  run();
  EXPECT_EQ(ran, std::vector<std::string>{});
}

TEST_F(Runner, DoesNotTimeAgainWhatUsedUpItsSeconds) {
  for (auto& planned : experiment.runs) planned.solve().budget_seconds = 0.25;  // a sample takes 0.3
  run();
  ran.clear();
  for (auto& planned : experiment.runs) planned.solve().repeat = 3;
  run();
  EXPECT_EQ(ran, std::vector<std::string>{});
}

TEST_F(Runner, LeavesNoRecordOfARunInterruptedBetweenTwoTimedSolves) {
  experiment.runs[0].solve().repeat = 2;
  std::stop_source stop;
  hooks.stop = stop.get_token();
  when(0, [&](RunResult&) { stop.request_stop(); });
  const RunCounts counts = run();
  EXPECT_TRUE(counts.interrupted);
  EXPECT_EQ(counts.done, 0);
  EXPECT_FALSE(fs::exists(record(0)));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
