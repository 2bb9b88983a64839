#include "solve/solver.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "error.hpp"
#include "problem/spin.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const char* const exact = "exact";
const char* const lbfgs = "limited-memory";

struct Way {
  std::string formulation;
  SettingTexts settings;
  std::string hessian;
  bool convexify = true;
};

std::string name_of(const Way& way) {
  std::string name = way.formulation;
  for (const auto& [key, value] : way.settings) name += "_" + value;
  return name + (way.hessian == lbfgs ? "_lbfgs" : way.convexify ? "_convex" : "_full");
}

std::ostream& operator<<(std::ostream& out, const Way& way) { return out << name_of(way); }

std::vector<Way> ways() {
  std::vector<Way> all = {{"voxel", {}, exact}, {"voxel", {}, lbfgs}};
  for (const char* bounds : {"midpoint", "ordered"}) {
    all.push_back({"rayrep", {{"bounds", bounds}}, exact, true});
    all.push_back({"rayrep", {{"bounds", bounds}}, exact, false});
    all.push_back({"rayrep", {{"bounds", bounds}}, lbfgs});
  }
  return all;
}

SolverOptions options_of(const Way& way) {
  SolverOptions options;
  options.convexify = way.convexify;
  options.own = solvers().find("ipopt").read({{"hessian_approximation", way.hessian}});
  return options;
}

Outcome solve(const Task& task, const SolverOptions& options) {
  return find_solver("ipopt", task.formulation.name()).solve(task, options);
}

void expect_consistent(const Task& task, const Outcome& outcome) {
  const Bounds& bounds = task.formulation.bounds();
  ASSERT_EQ(outcome.x.size(), task.formulation.num_variables());
  for (std::size_t i = 0; i < outcome.x.size(); ++i) {
    EXPECT_GE(outcome.x[i], bounds.lower[i]);
    EXPECT_LE(outcome.x[i], bounds.upper[i]);
  }
  EXPECT_EQ(outcome.moments, task.mass.total(task.formulation.moments(outcome.x)));
  EXPECT_EQ(outcome.objective, task.problem.value(outcome.moments));
  EXPECT_EQ(outcome.violation, violation(task.problem, outcome.moments));
  EXPECT_FALSE(outcome.message.empty());
  EXPECT_FALSE(outcome.history.empty());
  EXPECT_GT(outcome.evaluations.objective, 0);
  EXPECT_GT(outcome.evaluations.jacobian, 0);
  EXPECT_GT(outcome.kernel_seconds, 0);
  EXPECT_LE(outcome.kernel_seconds, outcome.solve_seconds);
}

class KnownOptimum : public testing::TestWithParam<Way> {};

TEST_P(KnownOptimum, OfTheLowestMassIsReached) {
  const Columns& domain = BoxDomain::columns();
  const auto f = make_formulation(GetParam().formulation, domain, {}, GetParam().settings, test_device());
  // A body that has more than the domain: a shell, and a void that is not empty.
  const MassModel mass{box_moments({0, 0, 0.5}, {0.5, 0.25, 0.125}), 0.75};
  const double filled = 0.65;  // 5.2 layers
  const LowestMass problem(mass.fixed[S1] + mass.contrast * BoxDomain::area * filled);
  const Task task{problem, *f, mass, test_device()};
  const Outcome outcome = solve(task, options_of(GetParam()));

  EXPECT_EQ(to_string(outcome.termination), "optimal") << outcome.message;
  expect_consistent(task, outcome);
  const double domain_optimum =
      f->name() == "voxel" ? BoxDomain::lowest_voxels(filled) : BoxDomain::lowest_rays(filled);
  const double want = mass.fixed[SZZ] + mass.contrast * domain_optimum;
  // The gap of a barrier method is the sum of its complementarity products, two bounds a variable and one
  // for a ray's order; what is left of the dual equations acts over the range of each variable (8 cells at
  // most). Ipopt relaxes bounds by 1e-8 of their size, which is up to 10 cells.
  const double n = static_cast<double>(f->num_variables());
  const double gap = 3 * n * outcome.complementarity + 8 * n * outcome.dual_infeasibility +
                     1e-7 * mass.contrast * domain.interior[SZZ];
  EXPECT_LT(gap, 2e-3 * want) << "or the solver stopped far from what it calls optimal";
  EXPECT_NEAR(outcome.objective, want, gap) << outcome.iterations << " iterations";
  EXPECT_LE(outcome.violation, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Ways, KnownOptimum, testing::ValuesIn(ways()),
                         [](const auto& p) { return name_of(p.param); });

/// A brick of volume one that stands askew and off its axis, on its smallest face: it cannot spin as it is.
struct Top {
  Top() {
    const Eigen::Matrix3d tilt = Eigen::AngleAxisd(0.03, Vec3(0.6, 0.8, 0)).toRotationMatrix();
    const Vec3 half(0.5, 0.4, 0.625);
    body = body_of(moved(box_mesh(-half, half), tilt, {0.015, -0.01, 0.65}));
    GridSpec grid;
    grid.resolution = 20;
    domain = make_columns(body, grid, {1, Wall::cells});
    mass = hollowed(body, domain.interior);
  }
  Body body;
  Columns domain;
  MassModel mass;
};

const Top& top() {
  static const Top top;
  return top;
}

/// The least objective over all fills, from the formulation whose moments are linear.
double voxel_optimum() {
  static const double value = [] {
    const auto f = make_formulation("voxel", top().domain, {}, {}, test_device());
    const Spin spin({});
    return solve({spin, *f, top().mass, test_device()}, {}).objective;
  }();
  return value;
}

class SpinSolve : public testing::TestWithParam<Way> {};

TEST_P(SpinSolve, IsOptimalFeasibleAndAgreesWithVoxels) {
  const auto f =
      make_formulation(GetParam().formulation, top().domain, {}, GetParam().settings, test_device());
  const Spin spin({});
  const Task task{spin, *f, top().mass, test_device()};
  const Outcome outcome = solve(task, options_of(GetParam()));
  EXPECT_EQ(to_string(outcome.termination), "optimal") << outcome.message;
  expect_consistent(task, outcome);
  // Ipopt's constr_viol_tol is 1e-4; tol = 1e-8 is what its error test asks of the constraints too.
  EXPECT_LE(outcome.violation, 1e-8);
  EXPECT_LT(outcome.objective, spin.value(top().body.solid)) << "no better than the solid body";
  RecordProperty("objective", std::to_string(outcome.objective));
  // One voxel column rarely wants a void in more than one piece, so the optima differ by discretisation
  // alone: a fraction of a cell at the end of each ray. One per cent of the objective at this resolution.
  EXPECT_NEAR(outcome.objective, voxel_optimum(), 0.01 * voxel_optimum());
}

std::vector<Way> spin_ways() {
  return {{"voxel", {}, exact},
          {"voxel", {}, lbfgs},
          {"rayrep", {{"bounds", "ordered"}}, exact, true},
          {"rayrep", {{"bounds", "ordered"}}, exact, false},
          {"rayrep", {{"bounds", "midpoint"}}, exact, true},
          {"rayrep", {{"bounds", "midpoint"}}, lbfgs}};
}

INSTANTIATE_TEST_SUITE_P(Ways, SpinSolve, testing::ValuesIn(spin_ways()),
                         [](const auto& p) { return name_of(p.param); });

class IpoptOn : public testing::Test {
 protected:
  Outcome run(const SolverOptions& options, double filled = 0.65) {
    const LowestMass problem(BoxDomain::area * filled);
    return solve({problem, *formulation_, MassModel{}, test_device()}, options);
  }
  void refuses(const std::string& name, const std::string& value, const std::string& part) {
    try {
      (void)solvers().find("ipopt").read({{name, value}});
      FAIL() << "accepted ipopt." << name << " = " << value;
    } catch (const InputError& e) {
      const std::string text = e.what();
      EXPECT_NE(text.find("ipopt." + name + " = " + value), std::string::npos) << text;
      EXPECT_NE(text.find(part), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
  }
  std::unique_ptr<Formulation> formulation_ =
      make_formulation("rayrep", BoxDomain::columns(), {}, {}, test_device());
};

TEST_F(IpoptOn, RefusesAnOptionItDoesNotKnow) {
  refuses("max_itr", "5", "ipopt has no setting of that name (did you mean max_iter?)");
}

TEST_F(IpoptOn, RefusesAValueOfTheWrongKindOrRange) {
  refuses("max_iter", "many", "is not a value Ipopt takes");
  refuses("max_iter", "5.5", "is not a value Ipopt takes");
  refuses("max_iter", "-1", "is not a value Ipopt takes");
  refuses("tol", "0", "is not a value Ipopt takes");
  refuses("tol", "1e-8x", "is not a value Ipopt takes");
  refuses("hessian_approximation", "bfgs", "is not a value Ipopt takes");
}

TEST_F(IpoptOn, AnEarlyStopSaysSoAndKeepsWhatItHas) {
  SolverOptions options;
  options.own = solvers().find("ipopt").read({{"max_iter", "3"}});
  const Outcome outcome = run(options);
  EXPECT_EQ(to_string(outcome.termination), "failed");
  EXPECT_EQ(outcome.message, "maximum number of iterations exceeded");
  EXPECT_EQ(outcome.iterations, 3);
  EXPECT_EQ(outcome.x.size(), formulation_->num_variables());
  EXPECT_EQ(outcome.history.size(), 4u) << "the start and three iterations";
}

TEST_F(IpoptOn, AMassThatDoesNotFitIsNotCalledOptimal) {
  const Outcome outcome = run({}, 1.5 * BoxDomain::height);
  EXPECT_NE(outcome.termination, Termination::optimal) << outcome.message;
  EXPECT_NE(outcome.termination, Termination::acceptable) << outcome.message;
  EXPECT_GT(outcome.violation, 0.4 * BoxDomain::area) << "half the height is missing";
}

TEST_F(IpoptOn, ReachesTheSameOptimumFromEveryStart) {
  for (const Start start : {Start::lower, Start::middle, Start::upper}) {
    SolverOptions options;
    options.start = start;
    const Outcome outcome = run(options);
    EXPECT_EQ(to_string(outcome.termination), "optimal") << outcome.message;
    EXPECT_NEAR(outcome.objective, BoxDomain::lowest_rays(0.65), 1e-4 * BoxDomain::lowest_rays(0.65))
        << "within a ten-thousandth: the stopping rule allows less than that from any start";
  }
}

TEST_F(IpoptOn, CountsTheCallbacksOfBothForms) {
  const Outcome lifted = run({});
  EXPECT_GT(lifted.evaluations.hessian, 0);
  SolverOptions options;
  options.own = solvers().find("ipopt").read({{"hessian_approximation", lbfgs}});
  EXPECT_EQ(run(options).evaluations.hessian, 0);
}

TEST(FindSolver, NamesTheSolversAndFormulationsThereAre) {
  EXPECT_EQ(find_solver("ipopt", "voxel").name, "ipopt");
  const auto message = [](std::string_view solver, std::string_view formulation) -> std::string {
    try {
      (void)find_solver(solver, formulation);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("snopt", "voxel").find("solver 'snopt' is unknown; expected one of: ipopt"), 0u);
  const std::string text = message("ipopt", "quadric");
  EXPECT_EQ(
      text.find("solver 'ipopt' does not work with formulation 'quadric'; it works with: voxel, rayrep"), 0u)
      << text;
}

TEST(ParseSolverOptions, TakesStartAndCurvatureAndRefusesTheRest) {
  EXPECT_TRUE(parse_solver_options({}).convexify);
  const SolverOptions options = parse_solver_options({{"start", "upper"}, {"curvature", "full"}});
  EXPECT_EQ(options.start, Start::upper);
  EXPECT_FALSE(options.convexify);
  EXPECT_TRUE(parse_solver_options({{"curvature", "convex"}}).convexify);
  EXPECT_THROW((void)parse_solver_options({{"curvature", "none"}}), InputError);
  EXPECT_THROW((void)parse_solver_options({{"begin", "upper"}}), InputError);
  EXPECT_THROW((void)parse_solver_options({{"start", "end"}}), InputError);
}

TEST(Termination, HasANameForEveryCase) {
  EXPECT_EQ(to_string(Termination::optimal), "optimal");
  EXPECT_EQ(to_string(Termination::acceptable), "acceptable");
  EXPECT_EQ(to_string(Termination::infeasible), "infeasible");
  EXPECT_EQ(to_string(Termination::failed), "failed");
  EXPECT_EQ(to_string(Termination::interrupted), "interrupted");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
