#include "solve/plane_sweep.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "error.hpp"
#include "problem/spin.hpp"
#include "problem/stand.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A base whose centroid is at (x, y).
Stand over(double x, double y) {
  return {{hull_of({{x - 1, y - 1}, {x + 1, y - 1}, {x + 1, y + 1}, {x - 1, y + 1}}), 0, 1}, std::nullopt};
}

struct Carved {
  std::unique_ptr<Formulation> voxels =
      make_formulation("voxel", BoxDomain::columns(), {}, {}, test_device());

  Outcome solve(const Problem& problem, const MassModel& mass) {
    return solve_with_plane_sweep({problem, *voxels, mass, test_device()}, {});
  }
};

constexpr double h = BoxDomain::h;

TEST(PlaneSweep, CarvesTheFarLayersOfABoxAndNothingElse) {
  // Six layers along x, the centre in the middle: without the two farthest it is one layer farther back.
  Carved box;
  const Outcome outcome = box.solve(over(-h, 0), {});
  EXPECT_EQ(to_string(outcome.termination), "acceptable") << outcome.message;
  EXPECT_NEAR(outcome.violation, 0, 1e-14);
  EXPECT_EQ(outcome.iterations, 1);
  std::size_t voxel = 0;
  for (const Interval& run : BoxDomain::columns().intervals)
    for (int k = run.k0; k < run.k1; ++k, ++voxel)
      EXPECT_EQ(outcome.x[voxel], BoxDomain::columns().grid.centre(0, run.ix) < h ? 1 : 0);
  EXPECT_EQ(outcome.moments, box.voxels->moments(outcome.x));
}

TEST(PlaneSweep, LeavesABodyAloneThatIsOverItsTarget) {
  Carved box;
  const Outcome outcome = box.solve(over(0, 0), {});
  EXPECT_EQ(outcome.iterations, 0);
  EXPECT_TRUE(std::ranges::all_of(outcome.x, [](double fill) { return fill == 1; }));
}

TEST(PlaneSweep, NeverEndsFartherFromTheTargetThanItBegan) {
  Carved box;
  std::mt19937 engine(7);
  const auto uniform = [&] { return 2 * static_cast<double>(engine()) / 4294967295.0 - 1; };
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector2d target(0.4 * uniform(), 0.3 * uniform());
    const MassModel mass{box_moments({0.1 * uniform(), 0, 0.5}, {0.5, 0.5, 0.5}), 1};
    const Moments solid = mass.total(BoxDomain::columns().interior);
    const Outcome outcome = box.solve(over(target[0], target[1]), mass);
    const auto off = [&](const Moments& s) { return (centre_of_mass(s).head<2>() - target).norm(); };
    EXPECT_LT(off(outcome.moments), off(solid)) << "target " << target.transpose();
    // What is on the near side pulls the right way: it stays.
    std::size_t voxel = 0;
    for (const Interval& run : BoxDomain::columns().intervals)
      for (int k = run.k0; k < run.k1; ++k, ++voxel)
        EXPECT_TRUE(outcome.x[voxel] == 0 || outcome.x[voxel] == 1);
    // A target within a quarter of the box's reach can be met to about what one voxel does.
    if (target.cwiseAbs().maxCoeff() < 0.08) {
      EXPECT_LT(off(outcome.moments), 2e-3);
    }
    const Outcome again = box.solve(over(target[0], target[1]), mass);
    EXPECT_EQ(again.x, outcome.x);
  }
}

/// A base whose edge towards +x is at `edge`, and all others far away.
Stand inside(double edge, double margin) {
  return {{hull_of({{-9, -9}, {edge, -9}, {edge, 9}, {-9, 9}}), 0, 1}, margin};
}

TEST(PlaneSweep, CarvesUntilTheCentreIsInsideTheBaseAndNoFurther) {
  // 6 x 32 voxels with the centre at 0. Without k of the farthest layer, at 2.5 h, it is at -2.5 h k / (192 -
  // k): k = 18 is the first to pass -h/4, and k = 32 is at -h/2.
  for (const auto& [margin, carved] : {std::pair{0.0, 18}, {h / 4, 32}}) {
    Carved box;
    const Stand stand = inside(-h / 4, margin);
    const Outcome outcome = box.solve(stand, {});
    EXPECT_EQ(to_string(outcome.termination), "acceptable") << outcome.message;
    EXPECT_EQ(outcome.iterations, 1);
    EXPECT_NEAR(outcome.violation, 0, 1e-14);
    EXPECT_NEAR(centre_of_mass(outcome.moments)[0], -2.5 * h * carved / (192 - carved), 1e-14);
    std::size_t voxel = 0;
    int empty = 0, high = 0;
    for (const Interval& run : BoxDomain::columns().intervals)
      for (int k = run.k0; k < run.k1; ++k, ++voxel) {
        if (outcome.x[voxel] == 1) continue;
        ++empty;
        high += k >= run.k1 - (carved + 3) / 4;  // four a level, the upper ones first
        EXPECT_GT(BoxDomain::columns().grid.centre(0, run.ix), 2 * h);
      }
    EXPECT_EQ(empty, carved);
    EXPECT_EQ(high, carved);
  }
}

TEST(PlaneSweep, LeavesABodyAloneThatStands) {
  Carved box;
  const Outcome outcome = box.solve(inside(0.5 * h, 0.25 * h), {});
  EXPECT_EQ(outcome.iterations, 0);
  EXPECT_TRUE(std::ranges::all_of(outcome.x, [](double fill) { return fill == 1; }));
}

TEST(PlaneSweep, FailsWhereTheBaseIsOutOfReach) {
  Carved box;
  const Outcome outcome = box.solve(inside(-4 * h, 0), {});  // beyond the interior, which ends at -3 h
  EXPECT_EQ(to_string(outcome.termination), "failed");
  EXPECT_GT(outcome.violation, 0);
}

TEST(PlaneSweep, IsRefusedForOtherProblems) {
  Carved box;
  const Base base{hull_of({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}), 0, 1};
  const auto refusal = [&](const Problem& problem) -> std::string {
    try {
      (void)box.solve(problem, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(MaxTilt(base, 0)),
            "solver 'plane-sweep' for stand as it is set; expected the problem stand with target = centre or "
            "inside");
  EXPECT_EQ(refusal(Spin({})),
            "solver 'plane-sweep' for spin as it is set; expected the problem stand with target = centre or "
            "inside");
  EXPECT_THROW((void)find_solver("plane-sweep", "rayrep"), InputError);
  EXPECT_THROW(require_problem(find_solver("plane-sweep", "voxel"), "spin"), InputError);
  EXPECT_NO_THROW(require_problem(find_solver("plane-sweep", "voxel"), "stand"));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
