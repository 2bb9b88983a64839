#include "experiment/published_table.hpp"

#include <gtest/gtest.h>

#include "experiment/recorded_runs.hpp"

namespace kreisel::core {
namespace {

Published printed() {
  Published p{"a paper", "a machine", {}};
  PublishedRow row;
  row.model = "ellipsoid";
  row.grid = {40, 26, 26};
  row.problem = "spin";
  row.rayrep = PublishedRow::Side{1000, 2.0};
  p.rows.push_back(row);
  return p;
}

TEST(Published, FindsARowByModelGridAndProblem) {
  Published p = printed();
  using Grid = std::array<int, 3>;
  EXPECT_EQ(p.find("ellipsoid", Grid{40, 26, 26}, "spin"), p.rows.data());
  EXPECT_EQ(p.find("ellipsoid", Grid{40, 26, 26}), p.rows.data()) << "any problem";
  EXPECT_EQ(p.find("ellipsoid", Grid{40, 26, 26}, "float"), nullptr);
  EXPECT_EQ(p.find("ellipsoid", Grid{40, 26, 27}, "spin"), nullptr);
  EXPECT_EQ(p.find("ellipsoid", {}, "spin"), nullptr);
  EXPECT_EQ(p.find("bird", Grid{40, 26, 26}, "spin"), nullptr);
  p.rows[0].grid.reset();
  p.rows[0].problem.clear();
  EXPECT_EQ(p.find("ellipsoid", Grid{1, 2, 3}, "float"), p.rows.data()) << "a row without either fits all";
  EXPECT_EQ(p.find("ellipsoid", {}), p.rows.data());
}

TEST(PublishedTable, SetsARunBesideThePapersRow) {
  const std::string text = to_text(published_tables({optimal_run()}, printed()));
  // 1300 variables are 30 % above 1000; 2 s are four times 0.5 s.
  EXPECT_EQ(squeezed_line(text, "ellipsoid"),
            "ellipsoid 40x26x26 spin | 1300 0.500 20 0.8 1.0e-10 yes | 1000 2 | +30.0 4.00");
  EXPECT_NE(text.find("paper: a paper; a machine\n"), std::string::npos) << text;
}

TEST(PublishedTable, LeavesThePaperEmptyWhereItHasNoSuchRow) {
  RecordedRun other_problem = optimal_run(), other_way = optimal_run();
  other_problem.run.asked().problem = "float";
  other_way.run.asked().formulation = "voxel";  // the row has ray-reps alone
  const Tables tables = published_tables({other_problem, other_way}, printed());
  const std::string text = to_text(tables);
  EXPECT_EQ(squeezed_line(text, "ellipsoid  40x26x26  float"),
            "ellipsoid 40x26x26 float | 1300 0.500 20 0.8 1.0e-10 yes | - - | - -");
  EXPECT_EQ(squeezed_line(text, "ellipsoid  40x26x26  spin"),
            "ellipsoid 40x26x26 spin | 1300 0.500 20 0.8 1.0e-10 yes | - - | - -");
  EXPECT_NE(to_csv(tables).find("0.5,0,1,20,0.8,1e-10,yes,,,,\n"), std::string::npos) << to_csv(tables);
}

TEST(PublishedTable, HasABlockALabelAndGivesNoSpeedForWhatDidNotConverge) {
  RecordedRun best = optimal_run(), paper = optimal_run(), missing = optimal_run();
  best.run.label = "best";
  paper.run.label = missing.run.label = "paper";
  paper.record->termination = "failed";
  paper.record->message = "too slow";
  missing.record.reset();
  const Tables tables = published_tables({paper, best, missing}, printed());
  ASSERT_EQ(tables.blocks.size(), 2u);
  EXPECT_EQ(tables.blocks[0].heading, "paper");
  EXPECT_EQ(tables.blocks[0].sheet.rows().size(), 2u);
  EXPECT_EQ(tables.blocks[0].notes, "! ellipsoid 40x26x26 rayrep ipopt: failed - too slow\n");
  EXPECT_EQ(squeezed_line(tables.blocks[0].sheet.text(), "ellipsoid"),
            "ellipsoid 40x26x26 spin | 1300 0.500 ! 20 0.8 1.0e-10 yes | 1000 2 | +30.0 -");
}

}  // namespace
}  // namespace kreisel::core
