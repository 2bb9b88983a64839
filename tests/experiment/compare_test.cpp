#include "experiment/compare.hpp"

#include <gtest/gtest.h>

#include "error.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TimedRun run(const std::string& model, const std::string& solver, std::vector<double> seconds,
             double objective = 1) {
  return {"run",
          {{"model", model}, {"formulation", "voxel"}, {"ipopt.linear_solver", solver}},
          "",
          "optimal",
          std::move(seconds),
          objective};
}

TEST(Compare, RunsAreMatchedByAllThatDescribesThem) {
  const Comparison c =
      compare({run("bird", "arrow", {2}), run("duck", "arrow", {1}), run("cat", "arrow", {1})},
              {run("duck", "arrow", {3}, 1.5), run("bird", "arrow", {1}), run("cow", "arrow", {1})});
  ASSERT_EQ(c.pairs.size(), 2u);
  EXPECT_EQ(c.pairs[0].name, "bird");
  EXPECT_EQ(*c.pairs[0].ratio, 0.5);
  EXPECT_FALSE(c.pairs[0].spread);
  EXPECT_EQ(*c.pairs[0].difference, 0);
  EXPECT_EQ(c.pairs[1].name, "duck");
  EXPECT_EQ(*c.pairs[1].ratio, 3);
  EXPECT_EQ(*c.pairs[1].difference, 0.5);
  EXPECT_EQ(c.only_a, std::vector<std::string>{"cat"});
  EXPECT_EQ(c.only_b, std::vector<std::string>{"cow"});
  EXPECT_NEAR(*c.mean(), std::sqrt(1.5), 4 * 0x1p-53);
  EXPECT_TRUE(c.across.empty());
}

TEST(Compare, ASettingThatTellsTheFoldersApartIsNoPartOfARun) {
  const Comparison c = compare({run("bird", "mumps", {4}), run("duck", "mumps", {9})},
                               {run("bird", "arrow", {1}), run("duck", "arrow", {3})});
  ASSERT_EQ(c.pairs.size(), 2u);
  EXPECT_EQ(*c.pairs[0].ratio, 0.25);
  EXPECT_EQ(c.across, std::vector<std::string>{"ipopt.linear_solver: mumps, arrow"});
}

TEST(Compare, ASettingThatVariesWithinAFolderTellsItsRunsApart) {
  const Comparison c = compare({run("bird", "mumps", {4}), run("bird", "arrow", {1})},
                               {run("bird", "arrow", {2}), run("bird", "mumps", {4})});
  ASSERT_EQ(c.pairs.size(), 2u);
  EXPECT_EQ(*c.pairs[0].ratio, 1);
  EXPECT_EQ(*c.pairs[1].ratio, 2);
  EXPECT_EQ(c.pairs[1].name, "ipopt.linear_solver=arrow");
}

TEST(Compare, WhatIsOfAnotherMachineIsNoPartOfARun) {
  TimedRun there = run("bird", "arrow", {1});
  there.config["device"] = "gpu";
  there.config["repeat"] = "9";
  EXPECT_EQ(compare({run("bird", "arrow", {1}), run("duck", "arrow", {1})}, {there}).pairs.size(), 1u);
}

TEST(Compare, TheSpreadIsThatOfTheQuotient) {
  // Quartiles of {8, 9, 10, 11, 12}: 9 and 11, half of it a tenth of the median; B has none.
  const Comparison c = compare({run("bird", "arrow", {10, 8, 12, 9, 11})}, {run("bird", "arrow", {13, 13})});
  EXPECT_NEAR(*c.pairs[0].ratio, 1.3, 4 * 0x1p-53);
  EXPECT_NEAR(*c.pairs[0].spread, 0.13, 4 * 0x1p-53);
  EXPECT_TRUE(c.pairs[0].above(1.16));
  EXPECT_FALSE(c.pairs[0].above(1.18)) << "the spread is in favour of B";
}

TEST(Compare, RunsThatFailedHaveNoRatio) {
  TimedRun broken = run("bird", "arrow", {});
  broken.objective.reset();
  broken.error = "out of memory";
  const Comparison c = compare({run("bird", "arrow", {1})}, {broken});
  ASSERT_EQ(c.pairs.size(), 1u);
  EXPECT_FALSE(c.pairs[0].ratio);
  EXPECT_FALSE(c.pairs[0].above(0.1));
  EXPECT_EQ(c.pairs[0].endings, "optimal, error");
  EXPECT_FALSE(c.mean());
}

TEST(Compare, TheTableMarksWhatIsAboveTheLimit) {
  const Comparison c = compare({run("bird", "arrow", {1}), run("duck", "arrow", {1})},
                               {run("bird", "arrow", {1}), run("duck", "arrow", {2})});
  const std::string text = to_text(table_of(c, 1.2)), csv = to_csv(table_of(c, 1.2));
  EXPECT_NE(text.find("2 !"), std::string::npos) << text;
  EXPECT_NE(csv.find("duck,2,,0,,yes"), std::string::npos) << csv;
  EXPECT_NE(csv.find("bird,1,,0,,no"), std::string::npos) << csv;
  EXPECT_EQ(to_text(table_of(c, {})).find('!'), std::string::npos);
}

TEST(Compare, AFolderWithoutRecordsIsRefused) {
  EXPECT_THROW((void)timed_runs("no-such-folder"), InputError);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
