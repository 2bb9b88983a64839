#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace THIS_FILE {

RunResult result_by(const std::string& linear_solver, double seconds, double objective) {
  RunResult r = optimal_result();
  if (!linear_solver.empty()) r.config.settings = {{"ipopt.linear_solver", linear_solver}};
  r.median.solve = seconds;
  r.samples = {r.median};
  r.outcome.objective = objective;
  return r;
}

TEST(LinearSolverTable, SetsBothBesideEachOther) {
  const Tables tables = tables_by("linear-solvers", {recorded(result_by("mumps", 0.6, 0.8), "exact"),
                                                     recorded(result_by("arrow", 0.04, 0.8000008), "exact")});
  ASSERT_EQ(tables.blocks.size(), 1u);
  // 20 iterations: 30 and 2 ms each; 15 times faster; 1e-6 of the objective apart.
  EXPECT_EQ(squeezed_line(tables.blocks[0].sheet.text(), "exact"),
            "exact ellipsoid 40x26x26 rayrep 1300 | 0.600 20 30.00 | 0.040 20 2.00 | 15.0 | 1e-06");
}

TEST(LinearSolverTable, ComparesConvergedSolvesAlone) {
  RunResult failed = result_by("mumps", 10, 0.9);
  failed.outcome.termination = Termination::failed;
  failed.outcome.message = "maximum CPU time exceeded";
  const Tables tables = tables_by(
      "linear-solvers", {recorded(failed, "exact"), recorded(result_by("arrow", 0.04, 0.8), "exact")});
  EXPECT_EQ(squeezed_line(tables.blocks[0].sheet.text(), "exact"),
            "exact ellipsoid 40x26x26 rayrep 1300 | 10.00 ! 20 500.00 | 0.040 20 2.00 | - | -");
  EXPECT_NE(to_text(tables).find("maximum CPU time exceeded"), std::string::npos);
}

TEST(LinearSolverTable, TakesARunWithoutTheOption) {
  const Tables tables = tables_by("linear-solvers", {recorded(result_by("", 0.04, 0.8), "exact")});
  EXPECT_EQ(squeezed_line(tables.blocks[0].sheet.text(), "exact"),
            "exact ellipsoid 40x26x26 rayrep 1300 | - - - | 0.040 20 2.00 | - | -");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
