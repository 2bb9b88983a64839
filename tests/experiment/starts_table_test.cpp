#include "experiment/starts_table.hpp"

#include <gtest/gtest.h>

#include "experiment/data_folder.hpp"
#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace {

RecordedRun start(const std::string& label, const std::string& seed, double objective, int evaluations) {
  RecordedRun run = optimal_run({{"moment.seed", seed}});
  run.run.label = label;
  run.run.asked().body.model = "heart";
  run.run.asked().problem = "top";
  run.run.asked().formulation = "quadric";
  RecordSummary& r = *run.record;
  r.objective = objective;
  r.evaluations = evaluations;
  r.iterations = evaluations / 2;
  r.median.solve = 1e-3 * evaluations;
  r.strict_minimum = "yes";
  r.smallest_eigenvalue = 2 - objective;
  return run;
}

TEST(StartsTable, CountsTheStartsThatEndAtTheLowestObjectiveOfTheirTask) {
  RecordedRun failed = start("heart top", "4", 0.4, 90), alone = start("other", "1", 0.5, 7);
  failed.record->termination = "failed";  // lower, but it did not converge
  failed.record->message = "no further progress";
  const std::vector<RecordedRun> runs = {start("heart top", "1", 0.75, 20), start("heart top", "2", 1, 60),
                                         start("heart top", "3", 0.75 * (1 + 9e-7), 30), failed, alone};
  const Tables tables = starts_tables(runs, read_published(published_file("quadric_2024")));
  ASSERT_EQ(tables.blocks.size(), 1u);
  const std::string text = tables.blocks[0].sheet.text();
  // Two of four; medians of the three that converged; the smaller eigenvalue of the two.
  EXPECT_EQ(squeezed_line(text, "heart top"),
            "heart top heart 40x26x26 4 2 2.00 | 15 [10, 30] 30 [20, 60] 30.00 [20.00, 60.00] | 0.75 "
            "1.0e-10 yes "
            "1.25 | 2.11")
      << text;
  EXPECT_EQ(squeezed_line(text, "other"),
            "other heart 40x26x26 1 1 1.00 | 3 7 7.00 | 0.5 1.0e-10 yes 1.5 | -")
      << text;
  EXPECT_EQ(tables.blocks[0].notes, "! heart top, seed 4: failed - no further progress\n");
  EXPECT_NE(tables.legend.find("10.1145/3658194"), std::string::npos);
  EXPECT_NE(tables.legend.find("machine, code and bodies are others"), std::string::npos);
}

TEST(StartsTable, SaysNothingOfATaskWithoutAResult) {
  RecordedRun none = start("heart top", "1", 1, 1), failed = start("heart top", "2", 1, 1);
  none.record.reset();
  failed.record->termination = "failed";
  const std::string text = starts_tables({none, failed}, std::nullopt).blocks[0].sheet.text();
  EXPECT_EQ(squeezed_line(text, "heart top"), "heart top heart 40x26x26 1 0 - | - - - | - - - - | -") << text;
}

}  // namespace
}  // namespace kreisel::core
