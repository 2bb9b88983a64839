#include "experiment/experiment_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "error.hpp"
#include "experiment/recorded_runs.hpp"
#include "experiment/runner.hpp"
#include "statistics.hpp"
#include "table/data_folder.hpp"
#include "table/published.hpp"
#include "table/table_parts.hpp"
#include "table/text_table.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

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
  return to_text(tables_by("speedup", runs, published));
}

Published published() { return read_published(published_file("rayrep_table2")); }

TEST(Published, HoldsTheNumbersOfTable2) {
  const Published p = published();
  ASSERT_EQ(p.rows.size(), table2.size());
  for (std::size_t i = 0; i < table2.size(); ++i) {
    const nlohmann::json& row = p.rows[i];
    EXPECT_EQ(row.at("model"), table2[i].model);
    EXPECT_EQ(row.at("grid"), table2[i].grid);
    EXPECT_EQ(row.at("rayrep").at("variables"), table2[i].ray_variables);
    EXPECT_EQ(row.at("rayrep").at("seconds"), table2[i].ray_seconds);
    EXPECT_EQ(row.at("voxel").at("variables"), table2[i].voxel_variables);
    EXPECT_EQ(row.at("voxel").at("seconds"), table2[i].voxel_seconds);
    EXPECT_EQ(row.at("speedup"), table2[i].speedup);
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
    const auto row = std::ranges::find_if(
        p.rows, [&](const nlohmann::json& r) { return r.at("model") == model && r.at("grid") == grid; });
    ASSERT_NE(row, p.rows.end()) << model;
    EXPECT_EQ(row->at("rayrep").at("variables"), variables);
    EXPECT_EQ(row->at("rayrep").at("seconds"), seconds);
    EXPECT_FALSE(row->contains("voxel") || row->contains("speedup"));
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
  EXPECT_EQ(half_interquartile_range({5}), 0);
  EXPECT_EQ(half_interquartile_range({1, 2}), 0.25);
  EXPECT_EQ(half_interquartile_range({9, 1, 3, 2, 4}), 1);
}

/// A result like the paper's own, objective 0.5.
RunResult made_by_hand(const Literal& row, bool rays) {
  RunResult r;
  r.config.body.model = r.body_name = row.model;
  r.config.grid.cells = r.grid.n = row.grid;
  r.config.formulation = rays ? "rayrep" : "voxel";
  r.config.settings = {{"ipopt.tol", rays ? "1e-8" : "1e-7"}};
  r.outcome.termination = Termination::optimal;
  r.variables = static_cast<std::size_t>(rays ? row.ray_variables : row.voxel_variables);
  const double seconds = rays ? row.ray_seconds : row.voxel_seconds;
  r.median = {0, 0, seconds, seconds};
  r.samples.assign(5, r.median);
  r.outcome.iterations = 20;
  r.outcome.objective = 0.5;
  r.provenance.device = "a device";
  r.provenance.commit = "abc1234";
  r.provenance.load = std::numeric_limits<double>::quiet_NaN();
  return r;
}

std::vector<RunResult> whole_table(std::size_t most = 2 * table2.size()) {
  std::vector<RunResult> results;
  for (const Literal& row : table2)
    for (const bool rays : {true, false}) results.push_back(made_by_hand(row, rays));
  results.resize(std::min(most, results.size()));
  return results;
}

std::vector<RecordedRun> on_record(const std::vector<RunResult>& results) {
  std::vector<RecordedRun> runs;
  for (const RunResult& r : results) runs.push_back(recorded(r, "paper"));
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
  const std::string text = speedup_text(on_record(whole_table()), published());
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
  for (RunResult& r : runs) {
    r.median.solve = 1234.56;
    r.samples = {{0, 0, 1000, 0}, {0, 0, 1234.56, 0}, {0, 0, 1500, 0}};
    r.outcome.iterations = 3000;
    r.outcome.objective = 0.123456;
    r.outcome.termination = Termination::acceptable;
  }
  for (const std::string& line : lines_of(speedup_text(on_record(runs), published()))) {
    const auto width = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    EXPECT_LE(width, 150) << line;
  }
}

TEST(SpeedupTable, ComputesDifferencesFromOurOwnNumbers) {
  auto runs = whole_table(2);
  runs[0].outcome.objective = 0.505;
  runs[0].variables = 6000;
  runs[0].median.solve = 3.58;
  EXPECT_EQ(
      line_with(speedup_text(on_record(runs), published()), "ellipsoid 80x52x51"),
      "ellipsoid 80x52x51 | 6000 3.58 ± 0.00 20 0.505 | 94975 34.74 ± 0.00 20 0.5 | +1.000 | 9.70 19.41 0.50 "
      "| +2.0 +0.0");
}

TEST(SpeedupTable, MarksWhatIsNotOptimalAndGivesNoSpeedupForIt) {
  auto runs = whole_table(4);
  runs[1].outcome.termination = Termination::failed;
  runs[1].outcome.message = "Restoration failed";
  runs[2].outcome.termination = Termination::acceptable;
  const std::string text = speedup_text(on_record(runs), published());
  EXPECT_EQ(
      line_with(text, "ellipsoid 80x52x51"),
      "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | 94975 34.74 ± 0.00 ! 20 0.5 | - | - 19.41 - | +0.0 "
      "+0.0");
  EXPECT_NE(text.find("! ellipsoid 80x52x51, voxel: failed - Restoration failed\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("! ellipsoid 64x42x41, rayrep: acceptable\n"), std::string::npos) << text;
  EXPECT_NE(line_with(text, "ellipsoid 64x42x41").find("16.17 16.11"), std::string::npos) << text;
}

TEST(SpeedupTable, ShowsADashForWhatDidNotRunOrEndedInAnError) {
  const auto results = whole_table(4);
  auto runs = on_record(results);
  runs[1].record.reset();
  runs[2] = failed_run(results[2], "out of memory", "paper");
  const std::string text = speedup_text(runs, published());
  EXPECT_EQ(line_with(text, "ellipsoid 80x52x51"),
            "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | - - - - | - | - 19.41 - | +0.0 -");
  EXPECT_EQ(line_with(text, "ellipsoid 64x42x41"),
            "ellipsoid 64x42x41 | - - ! - - | 46314 11.48 ± 0.00 20 0.5 | - | - 16.11 - | - +0.0");
  EXPECT_NE(text.find("! ellipsoid 64x42x41, rayrep: error - out of memory\n"), std::string::npos) << text;
}

TEST(SpeedupTable, ShowsTheLimitThatARunMetInPlaceOfItsSeconds) {
  auto results = whole_table(2);
  results[1].config.limits = {8, 600};
  auto runs = on_record(results);
  runs[1] = failed_run(results[1], "more than 8 GB", "paper");
  EXPECT_EQ(line_with(speedup_text(runs, published()), "ellipsoid 80x52x51"),
            "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | - more than 8 GB ! - - | - | - 19.41 - | +0.0 -");
}

TEST(SpeedupTable, HasTheSetUpBesideAQuadric) {
  auto runs = whole_table(2);
  EXPECT_EQ(speedup_text(on_record(runs), published()).find("set-up:"), std::string::npos);
  runs.push_back(runs[0]);
  runs[2].config.formulation = "quadric";
  runs[2].median = {0.25, 0, 0.00179, 0.25179};
  runs[2].samples.assign(51, runs[2].median);
  const std::string text = speedup_text(on_record(runs), published());
  EXPECT_NE(line_with(text, "ellipsoid 80x52x51").find("0.00179 ± 0.00000 0.25 0.5 | 1000 "),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("set-up: seconds from the model to its columns"), std::string::npos) << text;
}

TEST(SpeedupTable, PrintsOneTableALabelAndRowsInTheOrderOfThePaper) {
  std::vector<RecordedRun> runs = {recorded(made_by_hand(table2[4], true), "best"),
                                   recorded(made_by_hand(table2[1], true), "best"),
                                   recorded(made_by_hand(table2[0], true), "paper")};
  const std::string text = speedup_text(runs, published());
  const auto best = text.find("best\n"), ellipsoid = text.find("ellipsoid 64x42x41"),
             bird = text.find("bird 80x60x60"), paper = text.find("\npaper\n");
  EXPECT_LT(best, ellipsoid);
  EXPECT_LT(ellipsoid, bird);
  EXPECT_LT(bird, paper);
  EXPECT_NE(paper, std::string::npos);
}

TEST(SpeedupTable, WorksWithoutPublishedNumbers) {
  EXPECT_EQ(
      line_with(speedup_text(on_record(whole_table(2)), std::nullopt), "ellipsoid 80x52x51"),
      "ellipsoid 80x52x51 | 5882 1.79 ± 0.00 20 0.5 | 94975 34.74 ± 0.00 20 0.5 | +0.000 | 19.41 - - | - -");
}

TEST(SpeedupTable, GivesTheSameRowsAsCsv) {
  auto runs = on_record(whole_table(4));
  runs[3].record.reset();
  const auto lines = lines_of(to_csv(tables_by("speedup", runs, published())));
  ASSERT_EQ(lines.size(), 3u);
  const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
  for (const auto& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
  EXPECT_EQ(lines[1].find("paper,ellipsoid,80x52x51,5882,1.79,0,5,20,0.5,optimal,5882,1.79,0,94975,34.74,"),
            0u);
  EXPECT_NE(lines[2].find(",,,,,,,not run,46314,11.48,"), std::string::npos) << lines[2];
}

TEST(RunsTable, ListsEveryRunWithItsTerminationAndVerdict) {
  auto results = whole_table(3);
  results[0].verified.verdict.ok = true;
  results[0].outcome.violation = 2e-12;
  results[1].outcome.termination = Termination::infeasible;
  auto runs = on_record(results);
  runs[2].record.reset();
  runs.push_back(failed_run(made_by_hand(table2[5], true), "out of memory"));
  const std::string text = to_text(tables_by("runs", runs));
  EXPECT_NE(text.find("2.0e-12  yes\n"), std::string::npos) << text;
  EXPECT_NE(text.find("infeasible"), std::string::npos) << text;
  EXPECT_NE(text.find("not run"), std::string::npos) << text;
  EXPECT_NE(text.find("! bird 54x40x40 rayrep ipopt: error - out of memory\n"), std::string::npos) << text;
  const auto csv = lines_of(to_csv(tables_by("runs", runs)));
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
  EXPECT_EQ(table_text(experiment, runs), "A trial\n\n" + to_text(tables_by("runs", runs)));
  EXPECT_EQ(table_csv(experiment, runs), to_csv(tables_by("runs", runs)));
  experiment.table = "speedup";
  experiment.published = "rayrep_table2";
  EXPECT_EQ(table_text(experiment, runs), "A trial\n\n" + speedup_text(runs, published()));
  EXPECT_EQ(table_csv(experiment, runs), to_csv(tables_by("speedup", runs, published())));
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
  RunResult plain = optimal_result(), certified = optimal_result();
  certified.certificate.emplace().bound = 0.8 * (1 - 4e-4);
  plain.config.formulation = "voxel";
  for (const char* table : {"runs", "speedup", "published"}) {
    EXPECT_EQ(to_csv(tables_by(table, {recorded(plain)})).find("gap"), std::string::npos);
    const Tables tables = tables_by(table, {recorded(certified), recorded(plain)});
    EXPECT_NE(to_csv(tables).find("gap_percent"), std::string::npos) << to_csv(tables);
    EXPECT_NE(to_text(tables).find("0.04"), std::string::npos) << to_text(tables);
  }
  // No interior at all: nothing that a share could be of.
  certified.certificate->bound = std::numeric_limits<double>::infinity();
  EXPECT_EQ(cell_of_column(recorded(certified), "gap_percent").text, Cell::none().text);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
