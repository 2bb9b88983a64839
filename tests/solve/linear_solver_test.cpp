// Ipopt by Arrow against Ipopt by MUMPS: the same iterates, on everything that has the shape.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "error.hpp"
#include "solve/certified_cases.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {
namespace THIS_FILE {

struct Asked {
  std::string problem;
  SettingTexts settings;
};

struct Way {
  std::string formulation, hessian;
  SettingTexts settings = {};
  bool convexify = true;
};

std::vector<Asked> problems_asked() {
  return {{"spin", {}},
          {"top", {}},
          {"top", {{"form", "angle"}}},
          {"float", {{"draft", "60%"}}},
          {"stand", {}},
          {"stand", {{"target", "inside"}}},
          {"stand", {{"target", "max-tilt"}}},
          {"balance", {{"point", "0,0,0.6"}}},
          {"balance", {{"point", "0,0,0.6"}, {"line", "0,0,1"}}}};
}

std::vector<Way> ways_taken() {
  return {{"voxel", "exact"},
          {"voxel", "limited-memory"},
          {"rayrep", "exact"},
          {"rayrep", "exact", {}, false},
          {"rayrep", "limited-memory"},
          {"rayrep", "exact", {{"bounds", "ordered"}}},
          {"rayrep", "limited-memory", {{"bounds", "ordered"}}}};
}

template <class Map>
std::string values_of(const Map& settings) {
  std::string text;
  for (const auto& [name, value] : settings)
    for (const char c : "_" + value) text += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return text;
}

using Both = std::tuple<Asked, Way>;

std::string name_of(const Both& both) {
  const auto& [asked, way] = both;
  return asked.problem + values_of(asked.settings) + "_" + way.formulation + values_of(way.settings) +
         (way.hessian != "exact" ? "_lbfgs"
          : way.convexify        ? ""
                                 : "_full");
}

/// For names of tests that fail; Both is a tuple, whose own namespace has no operator for it.
void PrintTo(const Asked& asked, std::ostream* out) { *out << asked.problem << values_of(asked.settings); }
void PrintTo(const Way& way, std::ostream* out) { *out << way.formulation << values_of(way.settings); }

/// Askew, or where it is to stand on a face, upright.
const Case& body_for(const Asked& asked) {
  static const Case askew = top(0.015, 10);
  static const Case upright(body_of(moved(box_mesh({-0.5, -0.4, -0.625}, {0.5, 0.4, 0.625}),
                                          Eigen::Matrix3d::Identity(), {0.05, 0.02, 0.625})),
                            10);
  return asked.problem == "stand" ? upright : askew;
}

class TwoLinearSolvers : public testing::TestWithParam<Both> {};

Outcome solved(const Both& both, const std::string& linear_solver) {
  const auto& [asked, way] = both;
  const Case& brick = body_for(asked);
  const auto problem = make_problem(asked.problem, asked.settings, brick.body);
  const auto f =
      make_formulation(way.formulation, brick.domain, problem->traits(), way.settings, test_device());
  SolverOptions options;
  options.convexify = way.convexify;
  SettingTexts own = {{"hessian_approximation", way.hessian}, {"max_iter", "60"}};
  if (!linear_solver.empty()) own["linear_solver"] = linear_solver;
  options.own = solvers().find("ipopt").read(own);
  return solve(find_solver("ipopt", way.formulation), {*problem, *f, brick.mass, test_device()}, options);
}

/// L-BFGS learns the Hessian from how gradients change from step to step. Where the objective is linear they
/// do not, or only as the multipliers' part of the constraints does: what it learns is round-off.
bool secants_are_round_off(const Both& both) {
  const auto& [asked, way] = both;
  const bool linear =
      asked.problem == "float" || asked.problem == "balance" || asked.settings.contains("target");
  return way.hessian != "exact" && linear;
}

TEST_P(TwoLinearSolvers, TakeTheSameIterates) {
  const Outcome want = solved(GetParam(), "mumps"), got = solved(GetParam(), "");
  EXPECT_EQ(want.settings.at("linear_solver"), "mumps");
  EXPECT_EQ(got.settings.at("linear_solver"), "arrow") << "by itself, as the systems have that shape";
  EXPECT_EQ(to_string(got.termination), to_string(want.termination)) << got.message;
  // Ipopt's tol: where either may stop.
  EXPECT_NEAR(got.objective, want.objective, 1e-5 * (1 + std::abs(want.objective)));
  if (secants_are_round_off(GetParam())) return;
  // Both solve each system to about 1e-10 (Ipopt's residual_ratio_max); what that leaves grows from step to
  // step, more so where a Hessian is built from differences of steps.
  ASSERT_EQ(got.history.size(), want.history.size());
  for (std::size_t i = 0; i < want.history.size(); ++i) {
    const double size = 1e-6 * (1 + std::abs(want.history[i].objective));
    EXPECT_NEAR(got.history[i].objective, want.history[i].objective, size) << "iterate " << i;
    EXPECT_EQ(got.history[i].line_search_trials, want.history[i].line_search_trials) << "iterate " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(All, TwoLinearSolvers,
                         testing::Combine(testing::ValuesIn(problems_asked()),
                                          testing::ValuesIn(ways_taken())),
                         [](const auto& p) { return name_of(p.param); });

Both spin_by(const std::string& formulation) { return {{"spin", {}}, {formulation, "exact"}}; }

TEST(LinearSolver, IsMumpsWhereARegulariserTiesNeighbours) {
  static const Case brick = top(0.015, 24);
  const auto problem = make_problem("spin", {}, brick.body);
  const auto f = make_formulation("octree", brick.domain, problem->traits(), {}, test_device());
  const Task task{*problem, *f, brick.mass, test_device()};
  const auto& ipopt = find_solver("ipopt", "octree");
  EXPECT_EQ(solve(ipopt, task, {}).settings.at("linear_solver"), "mumps");
  SolverOptions asked;
  asked.own = ipopt.read({{"linear_solver", "arrow"}});
  const Outcome outcome = solve(ipopt, task, asked);
  EXPECT_EQ(outcome.settings.at("linear_solver"), "mumps");
  EXPECT_NE(outcome.message.find("by MUMPS: the systems are no arrow"), std::string::npos) << outcome.message;
}

TEST(LinearSolver, IsMumpsWhereAnOptionOfMumpsIsSet) {
  static const Case brick = top(0.015, 10);
  const auto problem = make_problem("spin", {}, brick.body);
  const auto f = make_formulation("voxel", brick.domain, problem->traits(), {}, test_device());
  const Task task{*problem, *f, brick.mass, test_device()};
  const auto& ipopt = find_solver("ipopt", "voxel");
  SolverOptions options;
  options.own = ipopt.read({{"mumps_pivot_order", "2"}});
  EXPECT_EQ(solve(ipopt, task, options).settings.at("linear_solver"), "mumps");
  options.own = ipopt.read({{"mumps_pivot_order", "2"}, {"linear_solver", "arrow"}});
  EXPECT_THROW(static_cast<void>(solve(ipopt, task, options)), InputError);
}

TEST(LinearSolver, CalledMa27IsNotInstalled) {
  EXPECT_THROW(static_cast<void>(solved(spin_by("voxel"), "ma27")), InputError);
  // Nor after Ipopt was given ours in its place.
  static_cast<void>(solved(spin_by("voxel"), "arrow"));
  EXPECT_THROW(static_cast<void>(solved(spin_by("voxel"), "ma27")), InputError);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
