#include "table/starts_table.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"
#include "table/data_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

RunResult start(const std::string& seed, double objective, int evaluations) {
  RunResult r = optimal_result({{"moment.seed", seed}});
  r.config.body.model = "heart";
  r.config.problem = "top";
  r.config.formulation = "quadric";
  r.outcome.objective = objective;
  r.outcome.evaluations.objective = evaluations;
  r.outcome.iterations = evaluations / 2;
  r.median.solve = 1e-3 * evaluations;
  LocalMinimum& minimum = r.outcome.local_minimum.emplace();
  minimum.strict = LocalMinimum::Answer::yes;
  minimum.smallest = 2 - objective;
  return r;
}

TEST(StartsTable, CountsTheStartsThatEndAtTheLowestObjectiveOfTheirTask) {
  RunResult failed = start("4", 0.4, 90);
  failed.outcome.termination = Termination::failed;  // lower, but it did not converge
  failed.outcome.message = "no further progress";
  const std::string task = "heart top";
  const std::vector<RecordedRun> runs = {recorded(start("1", 0.75, 20), task),
                                         recorded(start("2", 1, 60), task),
                                         recorded(start("3", 0.75 * (1 + 9e-7), 30), task),
                                         recorded(failed, task), recorded(start("1", 0.5, 7), "other")};
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
  RunResult failed = start("2", 1, 1);
  failed.outcome.termination = Termination::failed;
  const std::string text =
      starts_tables({missing_run(start("1", 1, 1), "heart top"), recorded(failed, "heart top")}, std::nullopt)
          .blocks[0]
          .sheet.text();
  EXPECT_EQ(squeezed_line(text, "heart top"), "heart top heart 40x26x26 1 0 - | - - - | - - - - | -") << text;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
