#include "table/settings_table.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace THIS_FILE {

RunResult with(const std::string& start, double seconds, double objective) {
  RunResult r = optimal_result({{"ipopt.max_iter", "300"}});
  if (!start.empty()) r.config.settings["solver.start"] = start;
  r.median.solve = seconds;
  r.samples = {r.median};
  r.outcome.objective = objective;
  return r;
}

RecordedRun run_with(const std::string& start, double seconds, double objective) {
  return recorded(with(start, seconds, objective));
}

TEST(SettingsTable, NamesRowsByWhatDiffersAndComparesThemWithFirstAndBest) {
  const Tables tables =
      settings_tables({run_with("", 2, 0.88), run_with("lower", 3, 0.8), run_with("upper", 1, 0.84)}, {});
  ASSERT_EQ(tables.blocks.size(), 1u);
  EXPECT_EQ(
      tables.blocks[0].heading,
      "ellipsoid 40x26x26, spin, rayrep; in all: density=1, ipopt.max_iter=300, solver=ipopt, wall=1.5h");
  const std::string text = tables.blocks[0].sheet.text();
  // 0.88 lies 10 % above 0.8, 0.84 5 %; 3 s are 1.5 times 2 s.
  EXPECT_EQ(squeezed_line(text, "defaults"), "defaults optimal 20 2.00 1.00 1300 0.88 10.000 1.0e-10 yes");
  EXPECT_EQ(squeezed_line(text, "start=lower"),
            "start=lower optimal 20 3.00 1.50 1300 0.8 0.000 1.0e-10 yes");
  EXPECT_EQ(squeezed_line(text, "start=upper"),
            "start=upper optimal 20 1.00 0.50 1300 0.84 5.000 1.0e-10 yes");
  EXPECT_EQ(text.find("factor"), std::string::npos) << "no column for labels that are not there";
  EXPECT_NE(to_csv(tables).find("solver.start=lower"), std::string::npos) << "with its group";
}

TEST(SettingsTable, CountsOnlyConvergedSolvesAsBestOrFast) {
  RunResult failed = with("lower", 0.1, 0.1);
  failed.outcome.termination = Termination::failed;
  failed.outcome.message = "maximum number of iterations exceeded";
  const Tables tables =
      settings_tables({run_with("", 2, 0.88), recorded(failed), missing_run(with("upper", 0, 0))}, {});
  const std::string text = to_text(tables);
  EXPECT_EQ(squeezed_line(text, "defaults"), "defaults optimal 20 2.00 1.00 1300 0.88 0.000 1.0e-10 yes");
  EXPECT_EQ(squeezed_line(text, "start=lower"), "start=lower failed 20 0.100 - 1300 0.1 - 1.0e-10 yes");
  EXPECT_EQ(squeezed_line(text, "start=upper"), "start=upper not run - - - - - - - -");
  EXPECT_NE(text.find("! start=lower: failed - maximum number of iterations exceeded\n"), std::string::npos)
      << text;
}

TEST(SettingsTable, HasABlockForEachBodyAndFormulationAndSaysAFactorOnce) {
  std::vector<RecordedRun> runs;
  for (const char* formulation : {"rayrep", "voxel"})
    for (const char* start : {"", "lower", "upper"}) {
      RunResult r = with(start, 1, 1);
      r.config.formulation = formulation;
      runs.push_back(recorded(r, *start ? "start" : "defaults"));
    }
  RunResult finer = with("", 1, 1);
  finer.config.grid.cells = finer.grid.n = {54, 35, 34};
  runs.push_back(recorded(finer));
  const Tables tables = settings_tables(runs, {});
  ASSERT_EQ(tables.blocks.size(), 3u);
  EXPECT_TRUE(tables.blocks[1].heading.starts_with("ellipsoid 40x26x26, spin, voxel;"))
      << tables.blocks[1].heading;
  const std::string text = tables.blocks[0].sheet.text();
  EXPECT_TRUE(squeezed_line(text, "start ").starts_with("start start=lower")) << text;
  EXPECT_TRUE(squeezed_line(text, "   ").starts_with(" start=upper")) << text;
  EXPECT_NE(to_csv(tables).find("rayrep,start,solver.start=upper,"), std::string::npos) << to_csv(tables);
}

TEST(FormulationsTable, ComparesFormulationsOfOneBodyAndDomain) {
  RunResult quadric = with("", 0.5, 0.8), rays = with("", 2, 0.88), exact = with("", 1, 0.7);
  for (RunResult* r : {&quadric, &exact}) r->config.formulation = "quadric";
  quadric.config.domain = "columns";
  quadric.certificate.emplace().bound = 0.8 * (1 - 1e-3);
  rays.config.settings["formulation.bounds"] = "midpoint";
  const Tables tables = formulations_tables({recorded(quadric), recorded(rays), recorded(exact)}, {});
  ASSERT_EQ(tables.blocks.size(), 2u) << "what is exact is not compared with columns";
  EXPECT_TRUE(tables.blocks[0].heading.starts_with("ellipsoid 40x26x26, spin, domain columns; in all: "))
      << tables.blocks[0].heading;
  EXPECT_TRUE(tables.blocks[1].heading.starts_with("ellipsoid 40x26x26, spin, domain exact; in all: "))
      << tables.blocks[1].heading;
  const std::string text = tables.blocks[0].sheet.text();
  // 0.88 lies 10 % above 0.8; 2 s are four times 0.5 s.
  EXPECT_EQ(squeezed_line(text, "quadric"), "quadric optimal 20 0.500 1.00 1300 0.8 0.000 1.0e-10 yes 0.1");
  EXPECT_EQ(squeezed_line(text, "rayrep"),
            "rayrep, bounds=midpoint optimal 20 2.00 4.00 1300 0.88 10.000 1.0e-10 yes -");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
