#include "experiment/linear_solver_table.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace {

RecordedRun run_by(const std::string& linear_solver, double seconds, double objective) {
  RecordedRun run = optimal_run({{"ipopt.linear_solver", linear_solver}});
  run.run.label = "exact";
  run.record->median.solve = seconds;
  run.record->samples = {run.record->median};
  run.record->objective = objective;
  return run;
}

TEST(LinearSolverTable, SetsBothBesideEachOther) {
  const Tables tables =
      linear_solver_tables({run_by("mumps", 0.6, 0.8), run_by("arrow", 0.04, 0.8000008)}, {});
  ASSERT_EQ(tables.blocks.size(), 1u);
  // 20 iterations: 30 and 2 ms each; 15 times faster; 1e-6 of the objective apart.
  EXPECT_EQ(squeezed_line(tables.blocks[0].sheet.text(), "exact"),
            "exact ellipsoid 40x26x26 rayrep 1300 | 0.600 20 30.00 | 0.040 20 2.00 | 15.0 | 1e-06");
}

TEST(LinearSolverTable, ComparesConvergedSolvesAlone) {
  RecordedRun failed = run_by("mumps", 10, 0.9);
  failed.record->termination = "failed";
  failed.record->message = "maximum CPU time exceeded";
  const Tables tables = linear_solver_tables({failed, run_by("arrow", 0.04, 0.8)}, {});
  EXPECT_EQ(squeezed_line(tables.blocks[0].sheet.text(), "exact"),
            "exact ellipsoid 40x26x26 rayrep 1300 | 10.00 ! 20 500.00 | 0.040 20 2.00 | - | -");
  EXPECT_NE(to_text(tables).find("maximum CPU time exceeded"), std::string::npos);
}

TEST(LinearSolverTable, TakesARunWithoutTheOption) {
  RecordedRun own = run_by("", 0.04, 0.8);
  own.run.asked().settings.clear();
  const Tables tables = linear_solver_tables({own}, {});
  EXPECT_EQ(squeezed_line(tables.blocks[0].sheet.text(), "exact"),
            "exact ellipsoid 40x26x26 rayrep 1300 | - - - | 0.040 20 2.00 | - | -");
}

}  // namespace
}  // namespace kreisel::core
