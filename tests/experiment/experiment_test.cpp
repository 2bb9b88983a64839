#include "experiment/experiment.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <map>
#include <set>

#include "error.hpp"
#include "experiment/experiment_table.hpp"
#include "table/data_folder.hpp"
#include "table/experiment_run.hpp"
#include "table/published.hpp"
#include "table/table_kinds.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Experiment parse(const std::string& text) { return parse_experiment(text, "folder/trial.toml"); }

std::vector<std::string> names(const Experiment& experiment) {
  std::vector<std::string> all;
  for (const auto& run : experiment.runs) all.push_back(run_text(run));
  return all;
}

using Texts = std::vector<std::string>;

TEST(Experiment, MultipliesListsOutInTheOrderOfTheFile) {
  const auto experiment = parse(R"(
    [[run]]
    resolution  = [80, 64]
    model       = ["ellipsoid", "bird"]
    formulation = ["rayrep", "voxel"]
  )");
  EXPECT_EQ(names(experiment),
            (Texts{"ellipsoid 80 rayrep ipopt", "ellipsoid 80 voxel ipopt", "bird 80 rayrep ipopt",
                   "bird 80 voxel ipopt", "ellipsoid 64 rayrep ipopt", "ellipsoid 64 voxel ipopt",
                   "bird 64 rayrep ipopt", "bird 64 voxel ipopt"}));
}

TEST(Experiment, ListsOfDefaultsVarySlowestAndARunReplacesThemWhole) {
  const auto experiment = parse(R"(
    resolution = [32, "40x30x20"]
    repeat = 5
    [[run]]
    formulation = ["rayrep", "voxel"]
    [[run]]
    resolution = 16
    repeat = 2
  )");
  EXPECT_EQ(names(experiment),
            (Texts{"ellipsoid 32 rayrep ipopt", "ellipsoid 32 voxel ipopt", "ellipsoid 40x30x20 rayrep ipopt",
                   "ellipsoid 40x30x20 voxel ipopt", "ellipsoid 16 rayrep ipopt"}));
  EXPECT_EQ(experiment.runs[0].solve().repeat, 5);
  EXPECT_EQ(experiment.runs[4].solve().repeat, 2);
}

TEST(Experiment, NamesItselfAfterItsFileAndKeepsWhatItSaysOfItsTable) {
  EXPECT_EQ(parse("[[run]]").name, "trial");
  EXPECT_EQ(parse("[[run]]").title, "trial");
  EXPECT_EQ(parse("[[run]]").table, "runs");
  const auto experiment = parse("title = 'A trial'\ntable = 'speedup'\npublished = 'x'\n[[run]]");
  EXPECT_EQ(experiment.title, "A trial");
  EXPECT_EQ(experiment.table, "speedup");
  EXPECT_EQ(experiment.published, "x");
  EXPECT_EQ(experiment.runs.size(), 1u);
}

TEST(Experiment, ReadsSettingsNestedOrQuotedAndMultipliesThemOutToo) {
  const auto experiment = parse(R"(
    set.ipopt.tol = 1e-9
    [[run]]
    [run.set]
    ipopt.mehrotra_algorithm = true
    "solver.start" = ["middle", "lower"]
  )");
  ASSERT_EQ(experiment.runs.size(), 2u);
  using Settings = std::map<std::string, std::string>;
  EXPECT_EQ(
      experiment.runs[0].asked().settings,
      (Settings{{"ipopt.mehrotra_algorithm", "yes"}, {"ipopt.tol", "1e-09"}, {"solver.start", "middle"}}));
  EXPECT_EQ(experiment.runs[1].asked().settings.at("solver.start"), "lower");
}

TEST(Experiment, GivesEachRunItsLabelAndMesh) {
  const auto experiment = parse("label = 'a'\n[[run]]\n[[run]]\nlabel = 'b'\nmesh = true\n");
  EXPECT_EQ(experiment.runs[0].label, "a");
  EXPECT_FALSE(experiment.runs[0].mesh);
  EXPECT_EQ(experiment.runs[1].label, "b");
  EXPECT_TRUE(experiment.runs[1].mesh);
}

/// One line: file, line number, what is wrong and what was expected.
void refuses(const std::string& text, unsigned line, const Texts& parts) {
  try {
    (void)parse(text);
    FAIL() << "accepted: " << text;
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find("folder/trial.toml: line " + std::to_string(line) + ": "), 0u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find("expected"), std::string::npos) << what;
    for (const auto& part : parts) EXPECT_NE(what.find(part), std::string::npos) << part << " in: " << what;
  }
}

TEST(Experiment, TakesAGapToCertify) {
  const TemporaryFolder folder;
  const auto experiment = read_experiment(
      folder.write("gap.toml", "certify = 1e-3\n[[run]]\nmodel = \"bird\"\n[[run]]\ncertify = 0.01"));
  EXPECT_EQ(experiment.runs.at(0).solve().certify, 1e-3);
  EXPECT_EQ(experiment.runs.at(1).solve().certify, 0.01);
}

TEST(Experiment, RefusesWhatIsNotToml) { refuses("repeat = 5\nbudget = = 3\n[[run]]", 2, {"TOML"}); }
TEST(Experiment, RefusesAnUnknownKey) { refuses("[[run]]\n\nresolutoin = 3", 3, {"resolutoin"}); }
TEST(Experiment, RefusesAnUnknownKeyAmongTheDefaults) { refuses("\ncolour = 3\n[[run]]", 2, {"colour"}); }
TEST(Experiment, RefusesAnUnfitValueAsTheCommandLineDoes) {
  RunConfig config;
  std::string same;
  try {
    set_field(config, "resolution", "many");
  } catch (const InputError& error) {
    same = error.what();
  }
  ASSERT_FALSE(same.empty());
  refuses("[[run]]\nresolution = 'many'", 2, {same});
}
TEST(Experiment, NamesTheLineOfTheListItemAtFault) {
  refuses("[[run]]\nresolution = [\n  32,\n  'many',\n]", 4, {"many"});
}
TEST(Experiment, RefusesAnEmptyList) { refuses("[[run]]\nmodel = []", 2, {"model", "empty list"}); }
TEST(Experiment, RefusesAListOfLists) { refuses("[[run]]\nresolution = [[80, 52, 51]]", 2, {"resolution"}); }
TEST(Experiment, RefusesATableWhereAValueBelongs) { refuses("[[run]]\n[run.ipopt]\ntol = 1", 2, {"ipopt"}); }
TEST(Experiment, TakesMapsBesideNothingElse) {
  const Experiment maps = parse(
      "table = 'maps'\naxes = 50\n[[run]]\nproblem = 'float'\ndrafts = '20%,40%'\n"
      "[[run]]\nthrough = ['lowest', 'centre']");
  ASSERT_EQ(maps.runs.size(), 3u);
  const auto& floats = std::get<MapRun>(*maps.runs[0].run);
  EXPECT_EQ(floats.formulation, "quadric");
  EXPECT_EQ(floats.axes, 50);
  EXPECT_EQ(floats.drafts, (std::vector<std::string>{"20%", "40%"}));
  EXPECT_EQ(describe(floats).at("drafts"), "20%,40%");
  EXPECT_EQ(std::get<MapRun>(*maps.runs[2].run).through, Through::centre);
  EXPECT_NE(run_name(maps.runs[1].run), run_name(maps.runs[2].run));
  EXPECT_TRUE(run_name(maps.runs[1].run).starts_with("ellipsoid-64-spin-map-"));
  refuses("[[run]]\naxes = 0", 2, {"axes", ">= 1"});
  refuses("[[run]]\nthrough = 'above'", 2, {"through", "lowest or centre"});
  refuses("[[run]]\naxes = 5", 2, {"table = \"maps\""});
  refuses("table = 'maps'\n[[run]]\nmodel = 'bird'", 3, {"axes or through"});
}

TEST(Experiment, RefusesAMeshOfARunThatMakesNoPart) {
  refuses("[[run]]\nmesh = true\npart = 'none'", 3, {"mesh", "part"});
  refuses("[[run]]\npart = 'some'", 2, {"none or written"});
  EXPECT_EQ(parse("[[run]]\npart = 'none'").runs[0].solve().part, Part::none);
}

TEST(Experiment, RefusesASettingOfAnUnknownGroup) {
  refuses("[[run]]\nset.snopt.tol = 1", 2, {"snopt.tol", "ipopt"});
}
TEST(Experiment, RefusesASettingWithoutAGroup) {
  refuses("[[run]]\nset.tol = 1", 2, {"tol", "set.GROUP.NAME"});
}
TEST(Experiment, RefusesASettingOutsideSet) {
  refuses("[[run]]\n'ipopt.tol' = 1", 2, {"ipopt.tol", "set.ipopt.tol"});
}
TEST(Experiment, RefusesSetThatIsNoTable) { refuses("[[run]]\nset = 'ipopt'", 2, {"set"}); }
TEST(Experiment, RefusesALabelThatIsNotText) { refuses("[[run]]\nlabel = ['a', 'b']", 2, {"label"}); }
TEST(Experiment, RefusesAMeshThatIsNoBoolean) {
  refuses("[[run]]\nmesh = 'yes'", 2, {"mesh", "true or false"});
}
TEST(Experiment, RefusesAnUnknownTable) { refuses("table = 'pie'\n[[run]]", 1, {"pie", "speedup"}); }
TEST(Experiment, SuggestsTheTableThatWasMeant) {
  refuses("table = 'setings'\n[[run]]", 1, {"did you mean 'settings'?"});
}
TEST(Experiment, RefusesATitleInsideARun) { refuses("[[run]]\ntitle = 'x'", 2, {"title"}); }
TEST(Experiment, RefusesARunInSingleBrackets) { refuses("[run]\nrepeat = 1", 1, {"[[run]]"}); }
TEST(Experiment, RefusesAFileWithoutRuns) { refuses("repeat = 1", 1, {"no run"}); }

/// Sets a variable of the environment for as long as it lives.
struct Variable {
  Variable(const char* name_, const std::string& value) : name(name_) {
    if (const char* old = getenv(name)) before = old, was_set = true;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { was_set ? setenv(name, before.c_str(), 1) : unsetenv(name); }
  const char* name;
  std::string before;
  bool was_set = false;
};

TEST(FindExperiment, TakesAPathOrANameFromTheDataFolder) {
  const TemporaryFolder folder;
  const auto file = folder.write("experiments/only_here.toml", "[[run]]");
  const Variable data("KREISEL_DATA", folder.path.string());
  EXPECT_EQ(find_experiment(file.string()), file);
  EXPECT_EQ(find_experiment("only_here"), file);
  EXPECT_EQ(find_experiment("only_here.toml"), file);
  EXPECT_EQ(read_experiment(file).name, "only_here");
}

TEST(FindExperiment, ListsTheNamesThereAreWhenItFindsNone) {
  const TemporaryFolder folder;
  folder.write("experiments/only_here.toml", "[[run]]");
  const Variable data("KREISEL_DATA", folder.path.string());
  try {
    (void)find_experiment("nowhere");
    FAIL() << "found";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("'nowhere'"), std::string::npos) << what;
    EXPECT_NE(what.find("only_here"), std::string::npos) << what;
  }
}

TEST(FindExperiment, SuggestsTheNameThatWasMeant) {
  const TemporaryFolder folder;
  folder.write("experiments/only_here.toml", "[[run]]");
  const Variable data("KREISEL_DATA", folder.path.string());
  try {
    (void)find_experiment("only_heer");
    FAIL() << "found";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'only_here'?"), std::string::npos) << error.what();
  }
}

TEST(FindExperiment, RefusesAFileThatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)read_experiment(folder.path / "none.toml"), InputError);
  EXPECT_THROW((void)read_experiment(folder.path), InputError);
}

TEST(DataFolder, RefusesAVariableThatNamesNoFolder) {
  const Variable data("KREISEL_DATA", "/no/such/folder");
  EXPECT_THROW((void)data_folder(), InputError);
  EXPECT_THROW((void)find_experiment("nowhere"), InputError);
}

TEST(DataFolder, HasTheExperimentsThatComeWithTheProgram) {
  EXPECT_TRUE(std::filesystem::is_directory(data_folder() / "experiments"));
}

TEST(Experiment, KeepsItsFiguresAndTheCommentItOpensWith) {
  const auto experiment =
      parse("# trial.toml - why?\n#\n# Because.\n\n# not this\nfigures = ['a', 'b']\n[[run]]");
  EXPECT_EQ(experiment.about, "trial.toml - why?\n\nBecause.\n");
  EXPECT_EQ(experiment.figures, (Texts{"a", "b"}));
  EXPECT_EQ(parse("[[run]]").about, "");
}
TEST(Experiment, RefusesFiguresThatAreNoListOfNames) {
  refuses("figures = 'settings'\n[[run]]", 1, {"figures", "list"});
  refuses("figures = [\n3]\n[[run]]", 2, {"figures"});
}

TEST(Experiment, CrossesSettingsWithEverythingElse) {
  const auto experiment = parse(R"(
    model = ["ellipsoid", "bird"]
    set.solver.start = ["lower", "middle", "upper"]
    [[run]]
    set.ipopt.hessian_approximation = ["exact", "limited-memory"]
  )");
  ASSERT_EQ(experiment.runs.size(), 12u);
  std::map<std::string, int> seen;
  for (const auto& run : experiment.runs)
    ++seen[run.asked().body.model + ' ' + run.asked().settings.at("solver.start") + ' ' +
           run.asked().settings.at("ipopt.hessian_approximation")];
  EXPECT_EQ(seen.size(), 12u) << "each combination once";
  EXPECT_EQ(experiment.runs[1].asked().settings.at("ipopt.hessian_approximation"), "limited-memory");
  EXPECT_EQ(experiment.runs[1].asked().settings.at("solver.start"), "lower");
  EXPECT_EQ(experiment.runs[2].asked().settings.at("solver.start"), "middle");
}

/// Every experiment that comes with the program, so that a typing error in one fails here and not after an
/// hour.
TEST(Experiments, AreReadAndNameTablesFiguresAndPublishedNumbersThatThereAre) {
  for (const auto& entry : std::filesystem::directory_iterator(data_folder() / "experiments")) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().string());
    const auto experiment = read_experiment(entry.path());
    EXPECT_NO_THROW((void)kind_set_out_by(experiment.table));
    for (const auto& figure : experiment.figures)
      EXPECT_TRUE(std::filesystem::exists(data_folder() / "plots" / (figure + ".py"))) << figure;
    if (!experiment.published.empty()) {
      EXPECT_NO_THROW((void)read_published(published_file(experiment.published)));
    }
    EXPECT_NE(experiment.title, experiment.name);
    EXPECT_TRUE(experiment.about.starts_with(experiment.name + ".toml - ")) << experiment.about;
  }
}

TEST(RayrepTable1, RunsThePapersFiveBodiesUnderThreeLabels) {
  const auto experiment = read_experiment(data_folder() / "experiments" / "rayrep_table1.toml");
  const auto printed = read_published(published_file("rayrep_table1"));
  std::map<std::string, int> count;
  for (const ExperimentRun& run : experiment.runs) {
    const RunConfig& config = run.solve();
    ++count[run.label];
    EXPECT_NE(printed.find(RecordedRun{run}), nullptr) << config.body.model;
    EXPECT_EQ(config.formulation, "rayrep");
    EXPECT_EQ(to_string(config.wall), "1.5h");
  }
  EXPECT_EQ(count, (std::map<std::string, int>{{"L-BFGS", 5}, {"best", 5}, {"best, MUMPS", 5}}));
}

TEST(SolverSettings, VaryOneFactorAtATimeAroundTheDefaults) {
  const auto experiment = read_experiment(data_folder() / "experiments" / "solver_settings.toml");
  std::map<std::string, int> defaults;
  for (const auto& [run, label, mesh] : experiment.runs) {
    const auto& config = std::get<RunConfig>(*run);
    auto settings = config.settings;
    settings.erase("ipopt.max_iter");
    settings.erase("ipopt.max_cpu_time");
    // A second factor stands beside L-BFGS alone.
    EXPECT_TRUE(settings.size() <= 1 || settings.contains("ipopt.hessian_approximation")) << label;
    EXPECT_LE(settings.size(), 2u) << label;
    EXPECT_EQ(settings.empty(), label == "defaults");
    if (settings.empty()) ++defaults[config.body.model + ' ' + config.formulation];
  }
  EXPECT_EQ(defaults,
            (std::map<std::string, int>{
                {"bird rayrep", 1}, {"bird voxel", 1}, {"ellipsoid rayrep", 1}, {"ellipsoid voxel", 1}}));
}

TEST(RayrepTable2, SolvesThePapersSevenGridsThreeWaysUnderTwoLabels) {
  const auto experiment = read_experiment(data_folder() / "experiments" / "rayrep_table2.toml");
  std::map<std::string, int> count;
  for (const auto& [run, label, mesh] : experiment.runs) {
    const auto& config = std::get<RunConfig>(*run);
    ++count[label + ' ' + config.formulation];
    EXPECT_EQ(config.problem, "spin");
    EXPECT_EQ(config.repeat, config.formulation == "quadric" ? 51 : 3);
    EXPECT_EQ(config.budget_seconds, 20);
    EXPECT_EQ(to_string(config.wall), "1.5h");
    EXPECT_EQ(domain_of(config), "columns") << "all are compared on one domain";
    EXPECT_EQ(config.certify, 1e-3);
    if (config.formulation == "quadric")
      EXPECT_TRUE(config.settings.empty());
    else
      EXPECT_EQ(config.settings.at("ipopt.hessian_approximation"),
                label == "L-BFGS" ? "limited-memory" : "exact");
    EXPECT_EQ(config.settings.contains("ipopt.mehrotra_algorithm"),
              label == "best" && config.formulation == "voxel");
    EXPECT_EQ(mesh, label == "best" && config.formulation == "rayrep" && config.body.model == "ellipsoid");
  }
  EXPECT_EQ(count, (std::map<std::string, int>{{"L-BFGS quadric", 7},
                                               {"L-BFGS rayrep", 7},
                                               {"L-BFGS voxel", 7},
                                               {"best quadric", 7},
                                               {"best rayrep", 7},
                                               {"best voxel", 7}}));
}

TEST(IpoptUntouched, SolvesTheSameGridsWithNothingOfOursWithinLimits) {
  const auto experiment = read_experiment(data_folder() / "experiments" / "ipopt_untouched.toml");
  const auto printed = read_published(published_file("rayrep_table2"));
  std::map<std::string, std::set<const void*>> rows;
  for (const ExperimentRun& run : experiment.runs) {
    const RunConfig& config = run.solve();
    rows[config.formulation + ' ' + config.settings.at("ipopt.hessian_approximation")].insert(
        printed.find(RecordedRun{run}));
    EXPECT_EQ(settings_of(config, "ipopt").size(), 1u) << "the Hessian alone";
    EXPECT_EQ(config.settings.at("solver.defaults"), "ipopt");
    EXPECT_EQ(config.settings.at("solver.curvature"), "full");
    EXPECT_EQ(config.limits.gigabytes, 8);
    EXPECT_EQ(config.limits.seconds, 600);
  }
  EXPECT_EQ(rows.size(), 4u);
  for (const auto& [way, found] : rows) {
    EXPECT_EQ(found.size(), printed.rows.size()) << way;
    EXPECT_FALSE(found.contains(nullptr)) << way;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
