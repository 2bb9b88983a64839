#include "experiment/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "error.hpp"
#include "experiment/data_folder.hpp"
#include "experiment/published.hpp"
#include "experiment/published_table.hpp"
#include "experiment/recorded_runs.hpp"
#include "experiment/runner.hpp"
#include "experiment/speedup_table.hpp"
#include "experiment/table_parts.hpp"
#include "experiment/text_table.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace {

struct Literal {
  std::string model;
  std::array<int, 3> grid;
  int ray_variables;
  double ray_seconds;
  int voxel_variables;
  double voxel_seconds, speedup;
};

/// Table 2 as printed in the paper.
const std::vector<Literal> table2 = {
    {"ellipsoid", {80, 52, 51}, 5882, 1.79, 94975, 34.74, 19.41},
    {"ellipsoid", {64, 42, 41}, 3706, 0.71, 46314, 11.48, 16.11},
    {"ellipsoid", {54, 35, 34}, 2536, 0.48, 26783, 3.48, 7.25},
    {"ellipsoid", {40, 26, 26}, 1390, 0.31, 10764, 1.37, 4.42},
    {"bird", {80, 60, 60}, 6184, 2.24, 100224, 17.94, 8.00},
    {"bird", {54, 40, 40}, 2646, 0.72, 28261, 4.43, 6.15},
    {"bird", {40, 30, 30}, 1414, 0.29, 11306, 2.20, 7.59},
};

std::string speedup_text(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  return to_text(speedup_tables(runs, published));
}

Published published() { return read_published(published_file("rayrep_table2")); }

TEST(Published, HoldsTheNumbersOfTable2) {
  const Published p = published();
  ASSERT_EQ(p.rows.size(), table2.size());
  for (std::size_t i = 0; i < table2.size(); ++i) {
    EXPECT_EQ(p.rows[i].model, table2[i].model);
    EXPECT_EQ(p.rows[i].grid, table2[i].grid);
    EXPECT_EQ(p.rows[i].rayrep.value().variables, table2[i].ray_variables);
    EXPECT_EQ(p.rows[i].rayrep.value().seconds, table2[i].ray_seconds);
    EXPECT_EQ(p.rows[i].voxel.value().variables, table2[i].voxel_variables);
    EXPECT_EQ(p.rows[i].voxel.value().seconds, table2[i].voxel_seconds);
    EXPECT_EQ(p.rows[i].speedup.value(), table2[i].speedup);
    // The printed speed-up is that of the printed times, up to their last digit.
    const double t = table2[i].ray_seconds, s = table2[i].voxel_seconds;
    EXPECT_GE(table2[i].speedup, (s - 0.005) / (t + 0.005) - 0.005);
    EXPECT_LE(table2[i].speedup, (s + 0.005) / (t - 0.005) + 0.005);
  }
}

TEST(Published, HoldsTheNumbersOfTable1) {
  const Published p = read_published(published_file("rayrep_table1"));
  ASSERT_EQ(p.rows.size(), 5u);
  const auto check = [&](const std::string& model, std::array<int, 3> grid, int variables, double seconds) {
    const PublishedRow* row = p.find(model, grid);
    ASSERT_NE(row, nullptr) << model;
    EXPECT_EQ(row->rayrep.value().variables, variables);
    EXPECT_EQ(row->rayrep.value().seconds, seconds);
    EXPECT_FALSE(row->voxel || row->speedup);
  };
  check("spheres", {51, 101, 101}, 4236, 0.499);
  check("kitten", {101, 92, 154}, 8176, 0.919);
  check("duck", {89, 105, 101}, 8087, 0.799);
  check("ellipsoid", {100, 65, 63}, 8682, 3.870);
  check("bird", {100, 75, 75}, 8776, 3.975);
}

TEST(Published, RefusesWhatIsMissingOrTorn) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)published_file("rayrep_table9"), InputError);
  EXPECT_THROW((void)read_published(folder.path / "none.json"), InputError);
  EXPECT_THROW((void)read_published(folder.write("a.json", "{")), InputError);
  EXPECT_THROW((void)read_published(folder.write("b.json", R"({"source": "s", "machine": "m"})")),
               InputError);
  EXPECT_THROW((void)read_published(folder.write(
                   "c.json", R"({"source": "s", "machine": "m", "rows": [{"model": "x", "grid": [1, 2]}]})")),
               InputError);
}

TEST(TextTable, AlignsByCodePointsAndPartsGroups) {
  TextTable table({{"", "name", true}, {"a long group", "n"}, {"a long group", "s"}});
  table.add({"x", "10", "1 ± 2"});
  table.add({"longer", "1", "-"});
  EXPECT_EQ(table.text(),
            "       | a long group\n"
            "name   |     n      s\n"
            "-------+-------------\n"
            "x      |    10  1 ± 2\n"
            "longer |     1      -\n");
  EXPECT_THROW(table.add({"too", "few"}), std::invalid_argument);
}

TEST(TextTable, QuotesCsvWhereItMust) {
  EXPECT_EQ(csv_line({"a", "b,c", "say \"x\"", ""}), "a,\"b,c\",\"say \"\"x\"\"\",\n");
}

TEST(TableParts, HalfTheInterquartileRangeIsInterpolated) {
  EXPECT_EQ(half_interquartile_range({}), 0);
  EXPECT_EQ(half_interquartile_range({{0, 0, 5, 0}}), 0);
  EXPECT_EQ(half_interquartile_range({{0, 0, 1, 0}, {0, 0, 2, 0}}), 0.25);
  EXPECT_EQ(half_interquartile_range({{0, 0, 9, 0}, {0, 0, 1, 0}, {0, 0, 3, 0}, {0, 0, 2, 0}, {0, 0, 4, 0}}),
            1);
}

/// A run of table 2 with a record like the paper's own, objective 0.5.
RecordedRun made_by_hand(const Literal& row, bool rays, const std::string& label = "paper") {
  RecordedRun run;
  run.run.label = label;
  run.run.asked().body.model = row.model;
  run.run.asked().grid.cells = row.grid;
  run.run.asked().formulation = rays ? "rayrep" : "voxel";
  run.run.asked().settings = {{"ipopt.tol", rays ? "1e-8" : "1e-7"}};
  RecordSummary& r = run.record.emplace();
  r.grid = row.grid;
  r.termination = "optimal";
  r.variables = static_cast<std::size_t>(rays ? row.ray_variables : row.voxel_variables);
  const double seconds = rays ? row.ray_seconds : row.voxel_seconds;
  r.median = {0, 0, seconds, seconds};
  r.samples.assign(5, r.median);
  r.iterations = 20;
  r.objective = 0.5;
  r.device = "a device";
  r.commit = "abc1234";
  return run;
}

std::vector<RecordedRun> whole_table() {
  std::vector<RecordedRun> runs;
  for (const Literal& row : table2)
    for (const bool rays : {true, false}) runs.push_back(made_by_hand(row, rays));
  return runs;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The line that begins so, with runs of blanks as one.
std::string line_with(const std::string& text, const std::string& beginning) {
  for (const std::string& line : lines_of(text)) {
    if (!line.starts_with(beginning)) continue;
    std::string out;
    for (const char c : line)
      if (c != ' ' || out.empty() || out.back() != ' ') out += c;
    return out;
  }
  return "no line begins with " + beginning;
}

TEST(SpeedupTable, SetsThePapersOwnNumbersBesideThemselves) {
  const std::string text = speedup_text(whole_table(), published());
  EXPECT_EQ(
      line_with(text, "ellipsoid 80x52x51"),
      "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | 94975 34.74 ± 0.00 20 0.5 | +0.000 | 19.41 19.41 1.00 "
      "| +0.0 +0.0");
  EXPECT_EQ(
      line_with(text, "bird 40x30x30"),
      "bird 40x30x30 | 1414 0.290 ± 0.000 20 0.5 | 11306 2.20 ± 0.00 20 0.5 | +0.000 | 7.59 7.59 1.00 | "
      "+0.0 +0.0");
  EXPECT_NE(text.find("ray-rep: ipopt, ipopt.tol=1e-8\n"), std::string::npos) << text;
  EXPECT_NE(text.find("voxel:   ipopt, ipopt.tol=1e-7\n"), std::string::npos) << text;
  EXPECT_NE(text.find("device a device; commit abc1234; 5 samples each\n"), std::string::npos) << text;
  EXPECT_NE(text.find("Computers & Graphics 58"), std::string::npos) << text;
  EXPECT_EQ(text.find('!'), std::string::npos) << text;
}

TEST(SpeedupTable, Fits150ColumnsWithRoomForSlowMachines) {
  auto runs = whole_table();
  for (auto& run : runs) {
    run.record->median.solve = 1234.56;
    run.record->samples = {{0, 0, 1000, 0}, {0, 0, 1234.56, 0}, {0, 0, 1500, 0}};
    run.record->iterations = 3000;
    run.record->objective = 0.123456;
    run.record->termination = "acceptable";
  }
  for (const std::string& line : lines_of(speedup_text(runs, published()))) {
    const auto width = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    EXPECT_LE(width, 150) << line;
  }
}

TEST(SpeedupTable, ComputesDifferencesFromOurOwnNumbers) {
  auto runs = whole_table();
  runs.resize(2);
  runs[0].record->objective = 0.505;
  runs[0].record->variables = 6000;
  runs[0].record->median.solve = 3.58;
  EXPECT_EQ(
      line_with(speedup_text(runs, published()), "ellipsoid 80x52x51"),
      "ellipsoid 80x52x51 | 6000 3.58 ± 0.00 20 0.505 | 94975 34.74 ± 0.00 20 0.5 | +1.000 | 9.70 19.41 0.50 "
      "| +2.0 +0.0");
}

TEST(SpeedupTable, MarksWhatIsNotOptimalAndGivesNoSpeedupForIt) {
  auto runs = whole_table();
  runs.resize(4);
  runs[1].record->termination = "failed";
  runs[1].record->message = "Restoration failed";
  runs[2].record->termination = "acceptable";
  const std::string text = speedup_text(runs, published());
  EXPECT_EQ(
      line_with(text, "ellipsoid 80x52x51"),
      "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | 94975 34.74 ± 0.00 ! 20 0.5 | - | - 19.41 - | +0.0 "
      "+0.0");
  EXPECT_NE(text.find("! ellipsoid 80x52x51, voxel: failed - Restoration failed\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("! ellipsoid 64x42x41, ray-rep: acceptable\n"), std::string::npos) << text;
  EXPECT_NE(line_with(text, "ellipsoid 64x42x41").find("16.17 16.11"), std::string::npos) << text;
}

TEST(SpeedupTable, ShowsADashForWhatDidNotRunOrEndedInAnError) {
  auto runs = whole_table();
  runs.resize(4);
  runs[1].record.reset();
  runs[2].record = RecordSummary{};
  runs[2].record->error = "out of memory";
  const std::string text = speedup_text(runs, published());
  EXPECT_EQ(line_with(text, "ellipsoid 80x52x51"),
            "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | - - - - | - | - 19.41 - | +0.0 -");
  EXPECT_EQ(line_with(text, "ellipsoid 64x42x41"),
            "ellipsoid 64x42x41 | - - ! - - | 46314 11.48 ± 0.00 20 0.5 | - | - 16.11 - | - +0.0");
  EXPECT_NE(text.find("! ellipsoid 64x42x41, ray-rep: error - out of memory\n"), std::string::npos) << text;
}

TEST(SpeedupTable, ShowsTheLimitThatARunMetInPlaceOfItsSeconds) {
  auto runs = whole_table();
  runs.resize(2);
  runs[1].run.solve().limits = {8, 600};
  runs[1].record = RecordSummary{};
  runs[1].record->error = "more than 8 GB";
  EXPECT_EQ(line_with(speedup_text(runs, published()), "ellipsoid 80x52x51"),
            "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | - more than 8 GB ! - - | - | - 19.41 - | +0.0 -");
}

TEST(SpeedupTable, HasTheSetUpBesideAQuadric) {
  auto runs = whole_table();
  runs.resize(2);
  EXPECT_EQ(speedup_text(runs, published()).find("set-up:"), std::string::npos);
  runs.push_back(runs[0]);
  runs[2].run.asked().formulation = "quadric";
  runs[2].record->median = {0.25, 0, 0.00179, 0.25179};
  runs[2].record->samples.assign(51, runs[2].record->median);
  const std::string text = speedup_text(runs, published());
  EXPECT_NE(line_with(text, "ellipsoid 80x52x51").find("0.00179 ± 0.00000 0.25 0.5 | 1000 "),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("set-up: seconds from the model to its columns"), std::string::npos) << text;
}

TEST(SpeedupTable, PrintsOneTableALabelAndRowsInTheOrderOfThePaper) {
  std::vector<RecordedRun> runs = {made_by_hand(table2[4], true, "best"),
                                   made_by_hand(table2[1], true, "best"),
                                   made_by_hand(table2[0], true, "paper")};
  const std::string text = speedup_text(runs, published());
  const auto best = text.find("best\n"), ellipsoid = text.find("ellipsoid 64x42x41"),
             bird = text.find("bird 80x60x60"), paper = text.find("\npaper\n");
  EXPECT_LT(best, ellipsoid);
  EXPECT_LT(ellipsoid, bird);
  EXPECT_LT(bird, paper);
  EXPECT_NE(paper, std::string::npos);
}

TEST(SpeedupTable, WorksWithoutPublishedNumbers) {
  auto runs = whole_table();
  runs.resize(2);
  EXPECT_EQ(
      line_with(speedup_text(runs, std::nullopt), "ellipsoid 80x52x51"),
      "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | 94975 34.74 ± 0.00 20 0.5 | +0.000 | 19.41 - - | - -");
}

TEST(SpeedupTable, GivesTheSameRowsAsCsv) {
  auto runs = whole_table();
  runs.resize(4);
  runs[3].record.reset();
  const auto lines = lines_of(to_csv(speedup_tables(runs, published())));
  ASSERT_EQ(lines.size(), 3u);
  const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
  for (const auto& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
  EXPECT_EQ(lines[1].find("paper,ellipsoid,80x52x51,5882,1.79,0,5,20,0.5,optimal,5882,1.79,0,94975,34.74,"),
            0u);
  EXPECT_NE(lines[2].find(",,,,,,,not run,46314,11.48,"), std::string::npos) << lines[2];
}

TEST(RunsTable, ListsEveryRunWithItsTerminationAndVerdict) {
  auto runs = whole_table();
  runs.resize(3);
  runs[0].record->verified_ok = true;
  runs[0].record->violation = 2e-12;
  runs[1].record->termination = "infeasible";
  runs[2].record.reset();
  runs.push_back(made_by_hand(table2[5], true, ""));
  runs.back().record->error = "out of memory";
  const std::string text = to_text(runs_tables(runs, {}));
  EXPECT_NE(text.find("2.0e-12  yes\n"), std::string::npos) << text;
  EXPECT_NE(text.find("infeasible"), std::string::npos) << text;
  EXPECT_NE(text.find("not run"), std::string::npos) << text;
  EXPECT_NE(text.find("! bird 54x40x40 rayrep ipopt: error - out of memory\n"), std::string::npos) << text;
  const auto csv = lines_of(to_csv(runs_tables(runs, {})));
  ASSERT_EQ(csv.size(), 5u);
  for (const auto& line : csv) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 17) << line;
}

TEST(Table, IsTheOneThatTheExperimentNames) {
  const TemporaryFolder folder;
  Experiment experiment =
      parse_experiment("title = 'A trial'\n[[run]]\nformulation = ['rayrep', 'voxel']", "t.toml");
  const auto runs = collect(experiment, folder.path);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_FALSE(runs[0].record);
  EXPECT_EQ(table_text(experiment, runs), "A trial\n\n" + to_text(runs_tables(runs, {})));
  EXPECT_EQ(table_csv(experiment, runs), to_csv(runs_tables(runs, {})));
  experiment.table = "speedup";
  experiment.published = "rayrep_table2";
  EXPECT_EQ(table_text(experiment, runs), "A trial\n\n" + speedup_text(runs, published()));
  EXPECT_EQ(table_csv(experiment, runs), to_csv(speedup_tables(runs, published())));
}

TEST(Table, FindsTheRecordsOfTheExperiment) {
  const TemporaryFolder folder;
  const Experiment experiment = parse_experiment("[[run]]\nresolution = [8, 9]", "t.toml");
  write_failure(record_path(folder.path, "t", experiment.runs[1]), experiment.runs[1].run, {}, "broken");
  const auto runs = collect(experiment, folder.path);
  EXPECT_FALSE(runs[0].record);
  ASSERT_TRUE(runs[1].record);
  EXPECT_EQ(runs[1].record->error, "broken");
}

TEST(GapColumn, IsThereWhenARunIsCertified) {
  RecordedRun plain = optimal_run(), certified = optimal_run();
  certified.record->gap = 4e-4;
  certified.record->bound = 0.79968;
  plain.run.asked().formulation = "voxel";
  for (const auto make : {runs_tables, speedup_tables, published_tables}) {
    EXPECT_EQ(to_csv(make({plain}, {})).find("gap"), std::string::npos);
    const Tables tables = make({certified, plain}, {});
    EXPECT_NE(to_csv(tables).find("gap_percent"), std::string::npos) << to_csv(tables);
    EXPECT_NE(to_text(tables).find("0.04"), std::string::npos) << to_text(tables);
  }
  // No interior at all: nothing that a share could be of.
  certified.record->gap = std::numeric_limits<double>::infinity();
  EXPECT_EQ(gap_cell(certified).text, Cell::none().text);
}

}  // namespace
}  // namespace kreisel::core
