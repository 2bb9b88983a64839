#include "experiment/absent_files.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "device/scoped_environment.hpp"
#include "experiment/experiment_table.hpp"
#include "experiment/runner.hpp"
#include "table/table_kinds.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Runs of which some name files that nobody has, in a folder of models that is empty.
class AbsentFiles : public testing::Test {
 protected:
  AbsentFiles() {
    options_.results = folder_.path / "runs";
    options_.log = log_.get();
    hooks_.provenance = [](const ExperimentRun&) { return Provenance{}; };
    hooks_.nest = [this](const NestConfig& config, const NestHooks&) {
      ran_.push_back(config.outer);
      NestResult result;
      result.config = config;
      result.valid = result.placed = true;
      result.scale = 0.5;
      return result;
    };
  }
  [[nodiscard]] std::string logged() const {
    std::string text(4096, '\0');
    std::rewind(log_.get());
    text.resize(std::fread(text.data(), 1, text.size(), log_.get()));
    return text;
  }
  [[nodiscard]] std::string table(const Experiment& experiment) const {
    return table_text(experiment, collect(experiment, options_.results));
  }

  TemporaryFolder folder_;
  const ScopedEnvironment models_{"KREISEL_MODELS", folder_.path.string()};
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> log_{std::tmpfile(), std::fclose};
  RunnerOptions options_;
  RunnerHooks hooks_;
  std::vector<std::string> ran_;
};

const std::string two_nestings =
    "table = 'nestings'\n[[run]]\nouter = 'bear'\n[[run]]\nouter = 'absent-one.obj'\ninner = "
    "'absent-two.stl'";

TEST_F(AbsentFiles, AreNotRunAndNotFailedButSaidInOneLine) {
  const Experiment experiment = parse_experiment(two_nestings, "t.toml");
  RunCounts counts = run_experiment(experiment, options_, hooks_);
  EXPECT_EQ(counts.done, 1);
  EXPECT_EQ(counts.absent, 1);
  EXPECT_EQ(counts.failed + counts.unconverged + counts.skipped, 0);
  EXPECT_EQ(ran_, std::vector<std::string>{"bear"});
  EXPECT_EQ(logged(),
            "absent-two in absent-one scale: skipped: no absent-one.obj, no absent-two.stl in the current "
            "folder nor in " +
                folder_.path.string() + "; --models names another\n");
  EXPECT_FALSE(std::filesystem::exists(record_path(options_.results, "t", experiment.runs[1])));

  options_.force = true;  // does not run what cannot be run, either
  counts = run_experiment(experiment, options_, hooks_);
  EXPECT_EQ(counts.done, 1);
  EXPECT_EQ(counts.absent, 1);
}

TEST_F(AbsentFiles, AreSaidByADryRun) {
  const std::string text = dry_run(parse_experiment(two_nestings, "t.toml"), options_);
  EXPECT_NE(text.find("skipped, no mesh file"), std::string::npos) << text;
  EXPECT_NE(text.find("no absent-one.obj, no absent-two.stl in"), std::string::npos) << text;
  EXPECT_NE(text.find("t: 1 to run, 0 finished, 1 skipped\n"), std::string::npos) << text;
}

TEST_F(AbsentFiles, AreRunOnceTheyAreInTheFolderUnderTheSameRecord) {
  const Experiment experiment = parse_experiment(two_nestings, "t.toml");
  (void)run_experiment(experiment, options_, hooks_);
  const auto path = record_path(options_.results, "t", experiment.runs[1]);
  folder_.write("absent-one.obj", "");
  folder_.write("absent-two.stl", "");
  const RunCounts counts = run_experiment(experiment, options_, hooks_);
  EXPECT_EQ(counts.done, 1);
  EXPECT_EQ(counts.absent, 0);
  EXPECT_EQ(path, record_path(options_.results, "t", experiment.runs[1]));
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_EQ(table(experiment).find("left out"), std::string::npos) << table(experiment);

  // A result stays one when the file goes.
  std::filesystem::remove(folder_.path / "absent-one.obj");
  EXPECT_EQ(run_experiment(experiment, options_, hooks_).skipped, 2);
  EXPECT_NE(table(experiment).find("absent-two in absent-one"), std::string::npos) << table(experiment);
}

TEST_F(AbsentFiles, OfSolvesAndMapsAreSkippedAsWell) {
  hooks_.run = [](const RunConfig&, const std::string&, const Control&) -> RunOutput {
    throw std::runtime_error("a run without its mesh");
  };
  hooks_.map = [](const MapRun&, const Control&) -> OrientationMap {
    throw std::runtime_error("a map without its mesh");
  };
  for (const char* text :
       {"[[run]]\nmodel = 'absent.stl'\nresolution = [32, 48]",
        "table = 'maps'\naxes = 2\n[[run]]\nmodel = 'absent.stl'\nproblem = ['spin', 'float']"}) {
    const Experiment experiment = parse_experiment(text, "t.toml");
    const RunCounts counts = run_experiment(experiment, options_, hooks_);
    EXPECT_EQ(counts.absent, 2) << text;
    EXPECT_EQ(counts.failed, 0) << text;
  }
}

TEST_F(AbsentFiles, AreLeftOutOfEveryKindOfTableWithANote) {
  for (const auto& [name, summary] : table_summaries()) {
    const std::string of = kind_set_out_by(name);
    const std::string run = of == "nesting" ? "outer = 'absent.stl'\nfree = 'all'\nseed = [1, 2]"
                            : of == "map"   ? "axes = 2\nmodel = 'absent.stl'\nproblem = ['spin', 'float']"
                                            : "kind = '" + (of.empty() ? "solve" : of) +
                                                "'\nmodel = 'absent.stl'\nresolution = [32, 48]";
    const Experiment experiment = parse_experiment("table = '" + name + "'\n[[run]]\n" + run, "t.toml");
    const Tables tables = tables_of(experiment, collect(experiment, options_.results));
    for (const Block& block : tables.blocks) {
      EXPECT_TRUE(block.sheet.rows().empty()) << name;
      EXPECT_EQ(block.notes, "") << name;
    }
    EXPECT_NE(tables.legend.find("left out: 2 runs, no absent.stl in the current folder nor in "),
              std::string::npos)
        << name << tables.legend;
  }
}

TEST_F(AbsentFiles, AreNotModelsNorNamesThatNobodyKnows) {
  for (const char* model :
       {"bear", "bunny", "beer"}) {  // of ours, of Debian's, of nobody: that one is refused
    ExperimentRun run;
    run.asked().body.model = model;
    EXPECT_EQ(text_of_absent(run), "") << model;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
