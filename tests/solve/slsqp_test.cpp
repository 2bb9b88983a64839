// slsqp_test.cpp - NLopt's SLSQP on octrees: known optima, Ipopt's optima, and what it refuses.
#include "solve/slsqp.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "problem/spin.hpp"
#include "problem/stand.hpp"
#include "refusal.hpp"
#include "solve/certified_cases.hpp"

namespace kreisel::core {
namespace THIS_FILE {

std::unique_ptr<Formulation> octree(const Columns& domain, const SettingTexts& settings = {}) {
  return make_formulation("octree", domain, {}, settings, test_device());
}

Outcome solve_by(const char* solver, const Task& task, const SolverOptions& options = {}) {
  return solve(find_solver(solver, "octree"), task, options);
}

TEST(Slsqp, FindsTheLowestMassWhichIsKnown) {
  const auto f = octree(BoxDomain::columns(), {{"start_level", "3"}, {"gamma_l", "0"}});  // 2 x 2 x 2
  const MassModel mass{box_moments({0, 0, 0.5}, {0.5, 0.25, 0.125}), 0.75};
  const double filled = 0.65;  // 5.2 layers
  const LowestMass problem(mass.fixed[S1] + mass.contrast * BoxDomain::area * filled);
  const Task task{problem, *f, mass, test_device()};
  const Outcome outcome = solve_by("slsqp", task);
  EXPECT_TRUE(outcome.converged()) << outcome.message;
  EXPECT_LE(outcome.violation, 1e-8);
  EXPECT_EQ(outcome.objective, problem.value(outcome.moments));
  const double want = mass.fixed[SZZ] + mass.contrast * BoxDomain::lowest_voxels(filled);
  // It stops when f changes by 1e-10 of itself a step, and steps may be as slow as a hundred to a digit.
  EXPECT_NEAR(outcome.objective, want, 1e-8 * want) << outcome.message;
}

TEST(Slsqp, EndsNearTheOptimumThatIpoptFindsOfAnOctreeThatIsRefined) {
  const Case brick = top(0.015, 8);
  const auto one = octree(brick.domain), other = octree(brick.domain);
  const Spin problem{SpinOptions{}};
  const Outcome got = solve_by("slsqp", {problem, *one, brick.mass, test_device()}),
                want = solve_by("ipopt", {problem, *other, brick.mass, test_device()});
  ASSERT_TRUE(got.converged()) << got.message;
  ASSERT_TRUE(want.converged()) << want.message;
  EXPECT_GE(got.refinements.size(), 2u);
  EXPECT_LE(got.violation, 1e-8);
  // It stops where f hardly changes over a step, which may be short of the optimum: 0.4 % here, measured. Not
  // below it by more than the octrees differ, which are fine along a void's surface of their own.
  EXPECT_LE(got.objective, 1.01 * want.objective);
  EXPECT_GE(got.objective, 0.999 * want.objective);
  ASSERT_EQ(got.refinements.front().variables, want.refinements.front().variables);
}

TEST(Slsqp, FindsTheMarginThatIpoptFinds) {
  const auto f = octree(BoxDomain::columns(), {{"start_level", "3"}});
  const MassModel mass{0.2 * box_moments({-0.06, 0.03, 0.8}, {1, 1, 1}), 0.75};
  const Base base{hull_of({{-0.2, -0.3}, {0.22, -0.25}, {0.1, 0.3}, {-0.15, 0.2}}), 0, 1.25};
  const MaxTilt problem(base, base.tangent(centre_of_mass(mass.total(BoxDomain::columns().interior))));
  const Task task{problem, *f, mass, test_device()};
  const Outcome got = solve_by("slsqp", task), want = solve_by("ipopt", task);
  ASSERT_TRUE(got.converged()) << got.message;
  EXPECT_GT(got.steps, 1);
  EXPECT_NEAR(got.objective, want.objective, 1e-4 * -want.objective);
}

TEST(Slsqp, SaysThatConstraintsOutOfReachAreMissed) {
  const auto f = octree(BoxDomain::columns(), {{"start_level", "4"}});
  const MassModel mass{0.2 * box_moments({0, 0, 0.5}, {0.5, 0.25, 0.125}), 0.75};
  const LowestMass problem(mass.fixed[S1] + 1.5 * mass.contrast * BoxDomain::columns().interior[S1]);
  const Outcome outcome = solve_by("slsqp", {problem, *f, mass, test_device()});
  EXPECT_EQ(outcome.termination, Termination::infeasible) << outcome.message;
  EXPECT_GT(outcome.violation, 1e-2);
}

TEST(Slsqp, RefusesMoreCellsThanItsMemoryIsFor) {
  const Case brick = top(0.015, 32);
  const Spin problem{SpinOptions{}};
  const auto fine = octree(brick.domain, {{"start_level", "5"}});
  ASSERT_GT(fine->num_variables(), slsqp_most_variables);
  expect_refusal(
      [&] {
        (void)solve_by("slsqp", {problem, *fine, brick.mass, test_device()});
      },
      fmt::format("solver 'slsqp' with {} cells", fine->num_variables()),
      {"expected 2000 at most", "memory grows with their square"});
}

TEST(Slsqp, RefusesOptionsThatItDoesNotKnow) {
  const Case brick = top(0.015, 8);
  const auto f = octree(brick.domain);
  const Spin problem{SpinOptions{}};
  for (const auto& [name, value] : {std::pair{"tol", "1e-3"}, {"ftol_rel", "0"}, {"maxeval", "1.5"}}) {
    expect_refusal(
        [&, name = name, value = value] {
          (void)solvers().find("slsqp").read({{name, value}});
        },
        fmt::format("slsqp.{} = ", name), {value});
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
