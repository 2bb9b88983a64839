// speedup_table_test.cpp - the quadric's columns; those of ray-reps and voxels alone are in table_test.cpp.
#include "experiment/speedup_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace {

RecordedRun run_of(const std::string& formulation, double seconds, double objective, double gap) {
  RecordedRun run = optimal_run();
  run.run.asked().formulation = formulation;
  run.run.asked().domain = "columns";
  RecordSummary& r = *run.record;
  r.median = {0, 0, seconds, seconds};
  r.samples = {r.median};
  r.objective = objective;
  r.gap = gap;
  return run;
}

std::vector<RecordedRun> three_ways() {
  return {run_of("rayrep", 0.5, 0.802, 0.003), run_of("voxel", 4, 0.801, 0.002),
          run_of("quadric", 0.002, 0.8, 4e-4)};
}

TEST(SpeedupTable, SetsAQuadricBesideBoth) {
  const Tables tables = speedup_tables(three_ways(), {});
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
  auto runs = three_ways();
  runs[1].record->termination = "failed";
  EXPECT_EQ(squeezed_line(to_text(speedup_tables(runs, {})), "ellipsoid"),
            "ellipsoid 40x26x26 | 0.500 | 4.00 ! | - - | 0.00200 0.00 0.8 | 250 - | 0.3 0.2 0.04");
  runs = three_ways();
  runs[2].record.reset();
  EXPECT_EQ(squeezed_line(to_text(speedup_tables(runs, {})), "ellipsoid"),
            "ellipsoid 40x26x26 | 0.500 | 4.00 | 8.00 - | - - - | - - | 0.3 0.2 -");
}

TEST(SpeedupTable, FitsALineWithQuadrics) {
  auto runs = three_ways();
  for (std::size_t i = 0; i < 2; ++i) {
    runs[i].record->median.solve = 1234.56;
    runs[i].record->samples = {{0, 0, 1000, 0}, {0, 0, 1234.56, 0}, {0, 0, 1500, 0}};
    runs[i].record->termination = "acceptable";
  }
  runs[2].record->samples = {{0, 0, 0.001, 0}, {0, 0, 0.002, 0}, {0, 0, 0.003, 0}};
  std::istringstream lines(to_text(speedup_tables(runs, {})));
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }), 150)
        << line;
}

}  // namespace
}  // namespace kreisel::core
