#include <gtest/gtest.h>

#include "problem/spin.hpp"
#include "solve/certified_cases.hpp"
#include "solve/ways.hpp"

namespace kreisel::core {
namespace THIS_FILE {

std::unique_ptr<Formulation> make(const Case& on, const std::string& name,
                                  const SettingTexts& settings = {}) {
  return make_formulation(name, on.domain, {}, settings, test_device());
}

const Spin& spin() {
  static const Spin problem{SpinOptions{}};
  return problem;
}

class RefineBy : public testing::TestWithParam<Way> {};

TEST_P(RefineBy, FindsTheOptimumOfTheVoxelsWhenAllCellsAreVoxels) {
  const Case brick = top(0.015, 12);
  const auto octree = make(brick, "octree", {{"start_level", "4"}, {"gamma_l", "0"}});
  const auto voxel = make(brick, "voxel");
  ASSERT_EQ(octree->num_variables(), voxel->num_variables());
  const Task task{spin(), *octree, brick.mass, test_device()},
      plain{spin(), *voxel, brick.mass, test_device()};
  const Outcome got = solve(default_solver("octree"), task, options_of(GetParam()));
  const Outcome want = solve(default_solver("voxel"), plain, options_of({"voxel", "exact"}));
  ASSERT_EQ(got.termination, Termination::optimal) << got.message;
  ASSERT_EQ(want.termination, Termination::optimal) << want.message;
  EXPECT_NEAR(got.objective, want.objective, 1e-4 * want.objective);
  EXPECT_LE(got.violation, 1e-8);
}

TEST_P(RefineBy, ReachesVoxelsAllAlongTheVoidAndStaysWithinAPercentOfTheBound) {
  const Case brick = top(0.015, 32);
  const auto octree = make(brick, "octree");
  const Task task{spin(), *octree, brick.mass, test_device()};
  const Outcome outcome = solve(default_solver("octree"), task, options_of(GetParam()));
  ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
  ASSERT_EQ(outcome.x.size(), octree->num_variables());
  EXPECT_LE(outcome.violation, 1e-8);

  const std::vector<Cube> cells = octree->cells();
  std::size_t along = 0;
  for (const auto& [low, high] : shared_faces(cells, octree_levels(brick.domain.grid)))
    if ((outcome.x[low] >= 0.5) != (outcome.x[high] >= 0.5)) {
      ++along;
      EXPECT_EQ(cells[low].edge, 1);
      EXPECT_EQ(cells[high].edge, 1);
    }
  EXPECT_GT(along, 100u);
  EXPECT_LT(cells.size(), brick.domain.interior_voxels);

  const Certificate bound = brick.certified(spin(), {.gap = gap});
  EXPECT_GE(outcome.objective, bound.bound);
  EXPECT_LE(outcome.objective, 1.01 * bound.bound);

  ASSERT_GE(outcome.refinements.size(), 4u) << "levels 2 to 5";
  const Refinement& last = outcome.refinements.back();
  EXPECT_EQ(last.variables, cells.size());
  EXPECT_EQ(last.cells.coarse, 0u);
  EXPECT_EQ(last.objective, outcome.objective);
  int iterations = 0;
  for (const Refinement& round : outcome.refinements) iterations += round.iterations;
  EXPECT_EQ(iterations, outcome.iterations);
}

INSTANTIATE_TEST_SUITE_P(Ways, RefineBy,
                         testing::Values(Way{"octree", "exact"}, Way{"octree", "limited-memory"}),
                         [](const auto& p) { return name_of(p.param); });

TEST(Refine, BeginsAgainFromCoarseCellsWithEverySolve) {
  const Case brick = top();
  const auto octree = make(brick, "octree");
  const std::size_t first = octree->num_variables();
  const Task task{spin(), *octree, brick.mass, test_device()};
  const Outcome once = solve(default_solver("octree"), task, {}),
                twice = solve(default_solver("octree"), task, {});
  EXPECT_EQ(twice.refinements.front().variables, first);
  EXPECT_EQ(once.x, twice.x);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
