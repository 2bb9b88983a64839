#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Published printed() {
  return {"a paper",
          "a machine",
          {{{"model", "ellipsoid"},
            {"grid", {40, 26, 26}},
            {"problem", "spin"},
            {"rayrep", {{"variables", 1000}, {"seconds", 2.0}}}}}};
}

TEST(Published, FindsARowByModelGridAndProblem) {
  Published p = printed();
  const auto fits = [&](const char* model, std::array<int, 3> grid, const char* problem) {
    return p.find(changed_run([&](RunResult& r) {
      r.config.body.model = model;
      r.config.grid.cells = r.grid.n = grid;
      r.config.problem = problem;
    })) == &p.rows[0];
  };
  EXPECT_TRUE(fits("ellipsoid", {40, 26, 26}, "spin"));
  EXPECT_FALSE(fits("ellipsoid", {40, 26, 26}, "float"));
  EXPECT_FALSE(fits("ellipsoid", {40, 26, 27}, "spin"));
  EXPECT_FALSE(fits("bird", {40, 26, 26}, "spin"));
  p.rows[0].erase("grid");
  p.rows[0].erase("problem");
  EXPECT_TRUE(fits("ellipsoid", {1, 2, 3}, "float")) << "a row without either fits all";
}

TEST(PublishedTable, SetsARunBesideThePapersRow) {
  const std::string text = to_text(tables_by("published", {recorded(optimal_result())}, printed()));
  // 1300 variables are 30 % above 1000; 2 s are four times 0.5 s.
  EXPECT_EQ(squeezed_line(text, "ellipsoid"),
            "ellipsoid 40x26x26 spin | 1300 0.500 20 0.8 1.0e-10 yes | 1000 2 | +30.0 4.00");
  EXPECT_NE(text.find("paper: a paper; a machine\n"), std::string::npos) << text;
}

TEST(PublishedTable, LeavesThePaperEmptyWhereItHasNoSuchRow) {
  const RecordedRun other_problem = changed_run([](RunResult&r) { r.config.problem = "float"; }),
                    // the row has ray-reps alone
      other_way = changed_run([](RunResult&r) { r.config.formulation = "voxel"; });
  const Tables tables = tables_by("published", {other_problem, other_way}, printed());
  const std::string text = to_text(tables);
  EXPECT_EQ(squeezed_line(text, "ellipsoid  40x26x26  float"),
            "ellipsoid 40x26x26 float | 1300 0.500 20 0.8 1.0e-10 yes | - - | - -");
  EXPECT_EQ(squeezed_line(text, "ellipsoid  40x26x26  spin"),
            "ellipsoid 40x26x26 spin | 1300 0.500 20 0.8 1.0e-10 yes | - - | - -");
  EXPECT_NE(to_csv(tables).find("0.5,0,1,20,0.8,1e-10,yes,,,,\n"), std::string::npos) << to_csv(tables);
}

TEST(PublishedTable, HasABlockALabelAndGivesNoSpeedForWhatDidNotConverge) {
  const auto fail = [](RunResult& r) {
    r.outcome.termination = Termination::failed;
    r.outcome.message = "too slow";
  };
  const Tables tables = tables_by("published",
                                  {changed_run(fail, "paper"), recorded(optimal_result(), "best"),
                                   missing_run(optimal_result(), "paper")},
                                  printed());
  ASSERT_EQ(tables.blocks.size(), 2u);
  EXPECT_EQ(tables.blocks[0].heading, "paper");
  EXPECT_EQ(tables.blocks[0].sheet.rows().size(), 2u);
  EXPECT_EQ(tables.blocks[0].notes, "! ellipsoid 40x26x26 rayrep ipopt: failed - too slow\n");
  EXPECT_EQ(squeezed_line(tables.blocks[0].sheet.text(), "ellipsoid"),
            "ellipsoid 40x26x26 spin | 1300 0.500 ! 20 0.8 1.0e-10 yes | 1000 2 | +30.0 -");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
