#include <gtest/gtest.h>

#include <fstream>
#include <memory>

#include "experiment/experiment_table.hpp"
#include "experiment/progress.hpp"
#include "experiment/runner.hpp"
#include "nest/search/baseline.hpp"
#include "record/kept_search.hpp"
#include "record/nest_record.hpp"
#include "refusal.hpp"
#include "table/data_folder.hpp"
#include "table/experiment_run.hpp"
#include "table/published.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// What a search over placements might have found.
NestResult found(const NestConfig& config, double scale) {
  NestResult result;
  result.config = config;
  result.outer_triangles = result.inner_triangles = 40;
  result.placed = result.valid = scale > 0;
  result.text = scale > 0 ? "valid" : "nothing that nests was found";
  result.scale = scale;
  result.evaluations = 1000;
  result.search_seconds = 2;
  result.setup_seconds = 0.5;
  if (scale > 0) {
    result.certified = nest::CertifiedScale{true, scale + 1e-4, 3, {}};
    result.sampled_scale = scale + 2e-4;
    result.timings = {{"peel", 100, 1000, scale}, {"envelope", 2, 30, scale}, {"hybrid", 0.5, 5, scale}};
  }
  result.trace = {{0, 0.1, 0.1, 1, 500}, {1, scale, 0.1, 1, 1000}};
  result.trace_seconds = {1, 2};
  return result;
}

class NestExperiment : public testing::Test {
 protected:
  NestExperiment() {
    options_.results = folder_.path;
    options_.log = log_.get();
    hooks_.provenance = [](const ExperimentRun&) { return Provenance{}; };
    hooks_.nest = [this](const NestConfig& config, const NestHooks&) {
      ran_.push_back(run_name(config));
      return found(config, 0.5 + 0.01 * static_cast<double>(seed_of(config)));
    };
  }
  [[nodiscard]] std::string table() const {
    return table_text(experiment_, collect(experiment_, options_.results));
  }

  TemporaryFolder folder_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> log_{std::tmpfile(), std::fclose};
  Experiment experiment_;
  RunnerOptions options_;
  RunnerHooks hooks_;
  std::vector<std::string> ran_;
};

/// Words of the line that begins with `start`, one blank between.
std::string line_of(const std::string& text, const std::string& start) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string squeezed;
    for (std::string word; words >> word;) squeezed += (squeezed.empty() ? "" : " ") + word;
    if (squeezed.starts_with(start)) return squeezed;
  }
  return {};
}

TEST_F(NestExperiment, RunsRecordsAndSkipsNestings) {
  experiment_ = parse_experiment(
      "table = 'nestings'\nouter = 'bear'\nfree = 'all'\n[[run]]\nlabel = 'first'\nseed = [1, 2]", "t.toml");
  ASSERT_EQ(experiment_.runs.size(), 2u);
  EXPECT_EQ(run_text(experiment_.runs[1]), "bear in bear hybrid+abort all seed 2 first");
  EXPECT_EQ(effort_of(experiment_.runs[0]).weight, 200 * 151);
  EXPECT_EQ(run_experiment(experiment_, options_, hooks_).done, 2);
  EXPECT_EQ(ran_.size(), 2u);
  EXPECT_EQ(run_experiment(experiment_, options_, hooks_).skipped, 2);
  EXPECT_EQ(line_of(table(), "first bear in bear"),
            "first bear in bear 80 all | 100 2 0.5 | 1e+03 30 5 | 2.50 | 0.5100 0.5101 0.5102")
      << table();
}

TEST_F(NestExperiment, RecordsWhatFailsAndRunsItAgain) {
  experiment_ = parse_experiment("table = 'nestings'\n[[run]]\nouter = 'bear'", "t.toml");
  hooks_.nest = [](const NestConfig&, const NestHooks&) -> NestResult {
    throw InputError("outer mesh gapes; expected less");
  };
  EXPECT_EQ(run_experiment(experiment_, options_, hooks_).failed, 1);
  EXPECT_NE(table().find("error - outer mesh gapes"), std::string::npos) << table();
  hooks_.nest = [](const NestConfig& config, const NestHooks&) { return found(config, 0.5); };
  EXPECT_EQ(run_experiment(experiment_, options_, hooks_).done, 1);
}

TEST_F(NestExperiment, LeavesNoRecordOfWhatTheUserStopped) {
  experiment_ = parse_experiment("table = 'nestings'\n[[run]]\nouter = 'bear'\nfree = 'all'", "t.toml");
  hooks_.nest = [](const NestConfig& config, const NestHooks&) {
    NestResult result = found(config, 0.5);
    result.ending = NestResult::Ending::interrupted;
    return result;
  };
  EXPECT_TRUE(run_experiment(experiment_, options_, hooks_).interrupted);
  EXPECT_NE(table().find("not run"), std::string::npos) << table();
}

TEST_F(NestExperiment, GoesOnWithASearchThatWasStoppedAndKeepsNothingOfIt) {
  experiment_ = parse_experiment(
      "table = 'nestings'\nouter = 'cuboid'\nfree = 'position'\nparticles = 6\niterations = 4\nclimbs = 0\n"
      "[[run]]\nexchange = [0, 2]",
      "t.toml");
  std::stop_source source;
  hooks_.stop = source.get_token();
  std::size_t resumed = 0;
  hooks_.nest = [&](const NestConfig& config, const NestHooks& given) {
    NestHooks hooks = given;
    if (hooks.resume) resumed = hooks.resume->state.trace.size();
    hooks.on_iteration = [&](const nest::SearchState& state) {
      if (state.trace.size() == 3 && !given.resume) source.request_stop();
      return true;
    };
    return run_nest(config, hooks);
  };
  EXPECT_TRUE(run_experiment(experiment_, options_, hooks_).interrupted);
  const auto kept =
      checkpoint_of(record_path(options_.results, "t", experiment_.runs[0]), experiment_.runs[0].nesting());
  EXPECT_TRUE(std::filesystem::exists(kept));
  source = std::stop_source();
  hooks_.stop = {};
  EXPECT_EQ(run_experiment(experiment_, options_, hooks_).done, 2);
  EXPECT_EQ(resumed, 3u);
  EXPECT_FALSE(std::filesystem::exists(kept)) << "there is a record";
  EXPECT_TRUE(std::filesystem::exists(
      checkpoint_of(record_path(options_.results, "t", experiment_.runs[1]), experiment_.runs[1].nesting())))
      << "the other islands may hear of it";
  EXPECT_EQ(records_in(options_.results).size(), 2u) << "a checkpoint is no record";
}

TEST_F(NestExperiment, BeginsASearchAnewWhoseCheckpointIsDamagedAndSaysSo) {
  experiment_ = parse_experiment(
      "table = 'nestings'\nouter = 'cuboid'\nfree = 'position'\nparticles = 6\niterations = 4\nclimbs = 0\n"
      "[[run]]",
      "t.toml");
  std::optional<NestCheckpoint> last;
  hooks_.nest = [&](const NestConfig& config, const NestHooks& given) {
    NestHooks hooks = given;
    hooks.keep = [&](const NestCheckpoint& now) { last = now; };
    hooks.on_iteration = [](const nest::SearchState& state) { return state.trace.size() < 3; };
    return run_nest(config, hooks);
  };
  options_.force = true;
  ASSERT_EQ(run_experiment(experiment_, options_, hooks_).done, 1);
  ASSERT_TRUE(last);
  const auto record = record_path(options_.results, "t", experiment_.runs[0]);
  const auto kept = checkpoint_of(record, experiment_.runs[0].nesting());
  hooks_.nest = run_nest;
  std::vector<std::string> said;
  hooks_.remark = [&](const ExperimentRun&, const std::string& line) { said.push_back(line); };
  const auto scale = [&] {
    EXPECT_EQ(run_experiment(experiment_, options_, hooks_).done, 1);
    EXPECT_FALSE(std::filesystem::exists(kept));
    return read_record(record).summary.at("scale").get<double>();
  };
  const double whole = scale();
  EXPECT_TRUE(said.empty());
  write_checkpoint(kept, *last);
  EXPECT_EQ(scale(), whole) << "a sound one goes on";
  EXPECT_TRUE(said.empty());
  // Of the right search, but its numbers are none of a search's; then torn.
  last->state.swarm.v.pop_back();
  write_checkpoint(kept, *last);
  EXPECT_EQ(scale(), whole);
  std::ofstream(kept) << "torn";
  EXPECT_EQ(scale(), whole);
  ASSERT_EQ(said.size(), 2u);
  for (const std::string& line : said)
    EXPECT_TRUE(line.starts_with("begins anew, its checkpoint is damaged: "));
  EXPECT_NE(said[1].find(kept.string()), std::string::npos) << said[1];
}

TEST_F(NestExperiment, SetsOutSettingsOverTheirSeeds) {
  experiment_ = parse_experiment(
      "table = 'nest-variants'\nouter = 'bear'\nfree = 'all'\nseed = [1, 2, 3]\n[[run]]\ntopology = "
      "['von-neumann', 'ring']\n[[run]]\nclimbs = 0",
      "t.toml");
  hooks_.nest = [](const NestConfig& config, const NestHooks&) {
    const double seed = static_cast<double>(seed_of(config));
    if (part_of<NestSearch>(config)->search.climbs == 0) return found(config, seed > 1 ? 0.3 : 0);
    return found(config,
                 (part_of<NestSearch>(config)->search.swarm.topology == nest::Topology::ring ? 0.6 : 0.5) +
                     0.01 * seed);
  };
  EXPECT_EQ(run_experiment(experiment_, options_, hooks_).done, 9);
  const std::string text = table();
  EXPECT_EQ(line_of(text, "topology = ring"),
            "topology = ring 3 | 1000 2.0 | 0.6200 0.6100 0.6150 0.6250 0.6300 | 2")
      << text;
  EXPECT_EQ(line_of(text, "climbs = 0"), "climbs = 0 3 | 1000 2.0 | 0.3000 0.0000 0.1500 0.3000 0.3000 | 0")
      << text;
  EXPECT_LT(text.find("topology = ring"), text.find("defaults")) << "the best first";
  EXPECT_LT(text.find("defaults"), text.find("climbs = 0"));
}

TEST_F(NestExperiment, CountsTheSeedsThatReachWhatAPaperDoes) {
  experiment_ = parse_experiment(
      "table = 'nest-variants'\npublished = 'nest_table1'\nouter = 'bunny'\nfree = 'all'\n[[run]]\nseed = "
      "[1, 2, "
      "3]",
      "t.toml");
  hooks_.nest = [](const NestConfig& config, const NestHooks&) {
    return found(config,
                 0.6 + 0.0049 * static_cast<double>(seed_of(config)));  // 0.6049 0.6098 0.6147
  };
  (void)run_experiment(experiment_, options_, hooks_);
  // Samples say 0.6051, 0.6100 and 0.6149; the paper's 0.61.
  EXPECT_TRUE(line_of(table(), "defaults").ends_with("| 3 2")) << table();

  // A stand-in says nothing of the paper's shape.
  for (ExperimentRun& run : experiment_.runs) run.nesting().outer = "kitten";
  (void)run_experiment(experiment_, options_, hooks_);
  EXPECT_TRUE(line_of(table(), "defaults").ends_with("| 3 -")) << table();
}

TEST_F(NestExperiment, SetsAPapersRowsBesideThoseOfTheirLabel) {
  experiment_ = parse_experiment(
      "table = 'nestings'\npublished = 'nest_table1'\nouter = 'bunny'\nfree = 'all'\n[[run]]\nlabel = "
      "'bunny'",
      "t.toml");
  (void)run_experiment(experiment_, options_, hooks_);
  const std::string line = line_of(table(), "bunny bunny in bunny");
  EXPECT_TRUE(line.ends_with("| 140000 1.7 32 135 0.61")) << line;
}

TEST_F(NestExperiment, CallsAStandInOneAndSetsThePapersScaleInParentheses) {
  experiment_ = parse_experiment(
      "table = 'nestings'\npublished = 'nest_table1'\nouter = 'bear'\nfree = 'all'\n[[run]]\nlabel = "
      "'falcon and key, stand-in'",
      "t.toml");
  (void)run_experiment(experiment_, options_, hooks_);
  const std::string line = line_of(table(), "falcon and key, stand-in bear in bear");
  EXPECT_TRUE(line.ends_with("| 26000 0.4 10 18 (0.90)")) << table();
}

TEST_F(NestExperiment, NamesASettingByItsLabel) {
  experiment_ = parse_experiment(
      "table = 'nest-variants'\nouter = 'bear'\nfree = 'all'\nseed = [1, 2]\n[[run]]\nlabel = 'a ring'\n"
      "topology = 'ring'\n[[run]]\nclimbs = 0",
      "t.toml");
  (void)run_experiment(experiment_, options_, hooks_);
  EXPECT_TRUE(line_of(table(), "a ring 2 |").starts_with("a ring")) << table();
  EXPECT_TRUE(line_of(table(), "climbs = 0").starts_with("climbs = 0")) << table();
}

// [Nest, s. 7.1, 7.2, 8]: 200 particles from random positions, 500 iterations, drawn to the best of all with
// 0.01, inertia 0.98, a scale search each with early abort; and nothing after it.
TEST(NestExperiments, CallNothingAsPublishedThatIsNot) {
  std::size_t called = 0;
  for (const std::string& name : experiment_names())
    for (const ExperimentRun& run : read_experiment(data_folder() / "experiments" / (name + ".toml")).runs) {
      if (!std::holds_alternative<NestConfig>(*run.run) ||
          run.label.find("as published") == std::string::npos)
        continue;
      ++called;
      const nest::SwarmOptions& swarm = part_of<NestSearch>(run.nesting())->search.swarm;
      EXPECT_EQ(swarm.placing, nest::Placing::anywhere) << name;
      EXPECT_EQ(part_of<NestSearch>(run.nesting())->search.climbs, 0) << name;
      EXPECT_EQ(part_of<NestSearch>(run.nesting())->swarm, "hybrid+abort") << name;
      EXPECT_EQ(swarm.topology, nest::Topology::global) << name;
      EXPECT_EQ(swarm.momentum, nest::Momentum::constant) << name;
      EXPECT_EQ(swarm.particles, 200) << name;
      EXPECT_EQ(swarm.iterations, 500) << name;
      EXPECT_EQ(swarm.inertia, 0.98) << name;
      EXPECT_EQ(swarm.own, 0.01) << name;
      EXPECT_EQ(swarm.social, 0.01) << name;
      EXPECT_EQ(swarm.swarms, 1) << name;
      EXPECT_EQ(swarm.patience, 0) << name;
      EXPECT_EQ(swarm.candidates, 1) << name;
    }
  EXPECT_GE(called, 2u) << "of nest_table1 and nest_seeds";
}

TEST(NestExperiments, ThatComeWithTheProgramAreWhatTheySay) {
  const auto read = [](const std::string& name) {
    return read_experiment(data_folder() / "experiments" / (name + ".toml"));
  };
  const Experiment table1 = read("nest_table1");
  const Published printed = read_published(published_file("nest_table1"));
  std::set<std::string> beside;
  for (const ExperimentRun& run : table1.runs) {
    ASSERT_TRUE(std::holds_alternative<NestSwarm>(run.nesting().kind));
    EXPECT_EQ(part_of<NestSearch>(run.nesting())->free, "all");
    const std::string row = run.label.substr(0, run.label.find(','));
    if (std::ranges::any_of(printed.rows, [&](const nlohmann::json& r) { return r.at("label") == row; }))
      beside.insert(row);
  }
  EXPECT_EQ(beside.size(), printed.rows.size()) << "every row of the paper's has one of ours";
  const Experiment dof = read("nest_dof");
  for (const ExperimentRun& run : dof.runs)
    if (run.label != "all free") {
      EXPECT_EQ(part_of<NestSearch>(run.nesting())->up, Vec3::UnitY());
    }
  std::set<std::string> swarms, topologies;
  for (const ExperimentRun& run : read("pso_variants").runs) {
    swarms.insert(part_of<NestSearch>(run.nesting())->swarm);
    topologies.emplace(to_string(part_of<NestSearch>(run.nesting())->search.swarm.topology));
  }
  EXPECT_EQ(swarms.size(), nest::variants().size() + nest::baselines.size());
  EXPECT_EQ(topologies.size(), 4u);
  for (const ExperimentRun& run : read("nest_accuracy").runs)
    EXPECT_GT(std::get<NestAccuracy>(run.nesting().kind).accuracy, 0);
}

TEST(NestExperiments, RefuseKeysOfSolvesAndWhatDoesNotFitWithTheLine) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& parts) {
    expect_refusal([&] { (void)parse_experiment(text, "t.toml"); }, "t.toml: line ", parts);
  };
  refused("table = 'nestings'\n[[run]]\nmodel = 'bear'",
          {"line 3", "model: a search of the scale has no such field"});
  refused("table = 'nestings'\n[[run]]\nouter = 'bear'\nfree = 'al'", {"line 4", "free part 'al'"});
  refused("table = 'nestings'\n[[run]]\nouter = 'bear'\nset.ipopt.tol = 1",
          {"ipopt.tol: a search of the scale has no such field"});
  refused("table = 'nestings'\n[[run]]\nfree = 'all'", {"line 3", "no outer shape"});
  refused("[[run]]\nouter = 'bear'", {"line 2", "with a search of the scale, expected a solve in every run"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
