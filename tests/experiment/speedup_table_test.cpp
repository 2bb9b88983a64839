// speedup_table_test.cpp - the quadric's columns; those of ray-reps and voxels alone are in table_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace THIS_FILE {

RunResult result_of(const std::string& formulation, double seconds, double objective, double gap) {
  RunResult r = optimal_result();
  r.config.formulation = formulation;
  r.config.domain = "columns";
  r.median = {0, 0, seconds, seconds};
  r.samples = {r.median};
  r.outcome.objective = objective;
  r.certificate.emplace().bound = objective * (1 - gap);
  return r;
}

std::vector<RunResult> three_ways() {
  return {result_of("rayrep", 0.5, 0.802, 0.003), result_of("voxel", 4, 0.801, 0.002),
          result_of("quadric", 0.002, 0.8, 4e-4)};
}

std::string text_of_table(const std::vector<RunResult>& results) {
  std::vector<RecordedRun> runs;
  for (const RunResult& r : results) runs.push_back(recorded(r));
  return to_text(tables_by("speedup", runs));
}

TEST(SpeedupTable, SetsAQuadricBesideBoth) {
  std::vector<RecordedRun> runs;
  for (const RunResult& r : three_ways()) runs.push_back(recorded(r));
  const Tables tables = tables_by("speedup", runs);
  const std::string text = to_text(tables);
  EXPECT_EQ(squeezed_line(text, "ellipsoid"),
            "ellipsoid 40x26x26 | 0.500 | 4.00 | 8.00 - | 0.00200 0.00 0.8 | 250 2000 | 0.3 0.2 0.04");
  EXPECT_NE(text.find("\n  quadric: moment\n"), std::string::npos) << text;
  const std::string csv = to_csv(tables);
  for (const char* column : {"rayrep_objective", "voxel_iterations", "objective_difference_percent",
                             "quadric_faster_than_rayrep", "quadric_gap_percent"})
    EXPECT_NE(csv.find(column), std::string::npos) << column << " is missing in\n" << csv;
}

TEST(SpeedupTable, ComparesAQuadricWithConvergedSolvesAlone) {
  auto results = three_ways();
  results[1].outcome.termination = Termination::failed;
  EXPECT_EQ(squeezed_line(text_of_table(results), "ellipsoid"),
            "ellipsoid 40x26x26 | 0.500 | 4.00 ! | - - | 0.00200 0.00 0.8 | 250 - | 0.3 0.2 0.04");
  results = three_ways();
  const std::string text =
      to_text(tables_by("speedup", {recorded(results[0]), recorded(results[1]), missing_run(results[2])}));
  EXPECT_EQ(squeezed_line(text, "ellipsoid"),
            "ellipsoid 40x26x26 | 0.500 | 4.00 | 8.00 - | - - - | - - | 0.3 0.2 -");
}

TEST(SpeedupTable, FitsALineWithQuadrics) {
  auto results = three_ways();
  for (std::size_t i = 0; i < 2; ++i) {
    results[i].median.solve = 1234.56;
    results[i].samples = {{0, 0, 1000, 0}, {0, 0, 1234.56, 0}, {0, 0, 1500, 0}};
    results[i].outcome.termination = Termination::acceptable;
  }
  results[2].samples = {{0, 0, 0.001, 0}, {0, 0, 0.002, 0}, {0, 0, 0.003, 0}};
  std::istringstream lines(text_of_table(results));
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }), 150)
        << line;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
