// Problems with nonlinear rows, and formulations whose variables move the body: what every solver must not
// have to be opened for again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "error.hpp"
#include "problem/turned.hpp"
#include "solve/explain.hpp"
#include "solve/nonlinear_problem.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const MassModel shell_of_nothing{Moments::Zero(), 1};

struct Way {
  std::string formulation, hessian, linear_solver;
};

Outcome solve_by(const Way& way, const Problem& problem) {
  const auto formulation = make_formulation(way.formulation, BoxDomain::columns(), {}, {}, test_device());
  SolverOptions options;
  options.own = solvers().find("ipopt").read(
      {{"hessian_approximation", way.hessian}, {"linear_solver", way.linear_solver}, {"tol", "1e-9"}});
  return solve(find_solver("ipopt", way.formulation),
               {problem, *formulation, shell_of_nothing, test_device()}, options);
}

class NonlinearRows : public testing::TestWithParam<Way> {};

TEST_P(NonlinearRows, EndWhereTheyBind) {
  // Half of the box's interior of 6 x 4 x 8 cells, centred on the axis: it can move by 3/2 cells at most.
  const double mass = BoxDomain::area / 2, radius = 0.1;
  const WithinACircle problem(mass, radius);
  const Outcome outcome = solve_by(GetParam(), problem);
  ASSERT_TRUE(outcome.converged()) << outcome.message;
  // Ipopt meets rows to 1e-9 of ours, by which the circle's radius changes by 1e-9 / (2 radius).
  EXPECT_NEAR(outcome.moments[SX], radius * mass, 1e-6 * mass);
  // Bounds of rows are relaxed by 1e-8 (bound_relax_factor) before they are met.
  EXPECT_LE(violation(problem, outcome.moments), 2e-8);
  EXPECT_NEAR(outcome.moments[SY], 0, 1e-2 * radius * mass) << "nothing is gained beside the axis";
}

TEST_P(NonlinearRows, DoNothingWhereTheyDoNotBind) {
  const double mass = BoxDomain::area / 2;
  const Outcome outcome = solve_by(GetParam(), WithinACircle(mass, 1));
  ASSERT_TRUE(outcome.converged()) << outcome.message;
  // All of it on the side of +x: cells from the middle to the wall, of which there are three across.
  EXPECT_NEAR(outcome.moments[SX], mass * 1.5 * BoxDomain::h, 1e-5 * mass);
}

INSTANTIATE_TEST_SUITE_P(Ways, NonlinearRows,
                         testing::Values(Way{"voxel", "exact", "arrow"}, Way{"voxel", "exact", "mumps"},
                                         Way{"voxel", "limited-memory", "arrow"},
                                         Way{"rayrep", "exact", "arrow"},
                                         Way{"rayrep", "limited-memory", "mumps"}),
                         [](const auto& p) {
                           std::string name =
                               p.param.formulation + "_" + p.param.hessian + "_" + p.param.linear_solver;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(NonlinearRow, IsSaidToBeWhatCannotBeMet) {
  // A shell too heavy, and too far from the axis, for anything to bring the centre of mass near it.
  const MassModel heavy{box_moments({1, 0, 0.6}, {2, 2, 2}), 1};
  const WithinACircle problem(heavy.fixed[S1] + BoxDomain::area / 2, 0.1);
  const auto formulation = make_formulation("voxel", BoxDomain::columns(), {}, {}, test_device());
  const Task task{problem, *formulation, heavy, test_device()};
  const SolverEntry& ipopt = find_solver("ipopt", "voxel");
  EXPECT_FALSE(solve(ipopt, task, {}).converged());
  EXPECT_EQ(explain_infeasible(ipopt, task, {}),
            "the circle cannot be met, though the linear constraints alone can");
}

TEST(NonlinearRow, CountAsViolation) {
  Moments s = Moments::Zero();
  s[S1] = 0.5, s[SX] = 0.1;
  EXPECT_NEAR(violation(WithinACircle(0.5, 0.1), s), 0.04 - 0.01, 4 * 0x1p-53);
  EXPECT_EQ(violation(WithinACircle(0.5, 0.3), s), 0);
}

TEST(NonlinearRow, AreRefusedByWhatKnowsLinearOnesAlone) {
  const WithinACircle problem(0.5, 0.1);
  try {
    require_form(find_solver("moment", "quadric"), problem);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "the circle does not work with solver 'moment'; expected solver ipopt");
  }
  EXPECT_NO_THROW(require_form(find_solver("ipopt", "voxel"), problem));
}

TEST(NonlinearRow, TurnWithTheirProblem) {
  // A quarter turn about z: what was along x is along y.
  const Turned turned(std::make_unique<WithinACircle>(0.5, 0.1),
                      Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix(),
                      Vec3(0.3, 0, 0));
  ASSERT_TRUE(turned.nonlinear());
  Moments s = Moments::Zero();
  s[S1] = 0.5, s[SX] = 0.02, s[SY] = 0.05;
  // x' = -y + 0.3, y' = x: sx' = -0.05 + 0.15, sy' = 0.02.
  EXPECT_NEAR(turned.nonlinear()->rows(s, {})[0], (0.01 + 0.0004) / 0.25, 16 * 0x1p-53);
  const Eigen::MatrixXd j = turned.nonlinear()->jacobian(s, {});
  const double step = std::cbrt(0x1p-52) / 4;
  for (int k = 0; k < 10; ++k) {
    const Moments up = s + step * Moments::Unit(k), down = s - step * Moments::Unit(k);
    const double slope =
        (turned.nonlinear()->rows(up, {})[0] - turned.nonlinear()->rows(down, {})[0]) / (up[k] - down[k]);
    // f is a quotient over 1/4; central differences are good to u^(2/3) of values a hundred times as large.
    EXPECT_NEAR(j(0, k), slope, 100 * std::pow(0x1p-52, 2.0 / 3)) << moment_names[k];
  }
}

/// Voxels, and one variable more: the shell lifted by t. What is designed stays where it is.
class LiftedShell final : public Formulation {
 public:
  LiftedShell(const Moments& shell)
      : voxels_(make_formulation("voxel", BoxDomain::columns(), {}, {}, test_device())),
        bounds_(voxels_->bounds()),
        shell_(shell) {
    bounds_.lower.push_back(-1);
    bounds_.upper.push_back(1);
  }
  [[nodiscard]] std::string_view name() const override { return "lifted-shell"; }
  [[nodiscard]] std::size_t num_variables() const override { return voxels_->num_variables() + 1; }
  [[nodiscard]] const Bounds& bounds() const override { return bounds_; }
  [[nodiscard]] Moments moments(std::span<const double> x) override {
    return voxels_->moments(x.first(x.size() - 1));
  }
  void pull_back(std::span<const double> x, std::span<const Moments> weights,
                 std::span<double> out) override {
    const std::size_t n = num_variables();
    std::vector<double> fills((n - 1) * weights.size());
    voxels_->pull_back(x.first(n - 1), weights, fills);
    for (std::size_t r = 0; r < weights.size(); ++r) {
      std::copy_n(fills.begin() + r * (n - 1), n - 1, out.begin() + r * n);
      out[r * n + n - 1] = 0;
    }
  }
  void curvature(std::span<const double>, const Moments&, std::span<double>) override {
    throw std::logic_error("asked for a curvature that there is not");
  }
  [[nodiscard]] std::size_t moving() const override { return 1; }
  [[nodiscard]] Moments moved(std::span<const double> x) override { return at(x.back()) - shell_; }
  void add_moved(std::span<const double> x, std::span<const Moments> weights,
                 std::span<double> out) override {
    const double t = x.back(), step = 1e-5;  // at(t) is of second order in t: central differences are exact
    const Moments slope = (at(t + step) - at(t - step)) / (2 * step);
    for (std::size_t r = 0; r < weights.size(); ++r)
      out[(r + 1) * num_variables() - 1] += weights[r].dot(slope);
  }
  [[nodiscard]] Rounded round(std::span<const double> x) const override {
    return voxels_->round(x.first(x.size() - 1));
  }

 private:
  [[nodiscard]] Moments at(double t) const {
    return transformed(shell_, Eigen::Matrix3d::Identity(), Vec3(0, 0, t));
  }

  std::unique_ptr<Formulation> voxels_;
  Bounds bounds_;
  Moments shell_;
};

/// As much material as possible, with the centre of mass at a given height: minimise -s1 subject to
/// sz = height * s1.
class Heaviest final : public RowsProblem {
 public:
  explicit Heaviest(double height) : RowsProblem(Goal::value, Filling::segment) {
    add("height", Moments(Moments::Unit(SZ) - height * Moments::Unit(S1)), 0, 0);
  }
  [[nodiscard]] double value(const Moments& s) const override { return -s[S1]; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return -Moments::Unit(S1); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
};

TEST(MovingVariables, MoveTheBodyInPlaceOfItsMaterial) {
  const Moments shell = box_moments({0, 0, 0.6}, {0.5, 0.5, 0.8});
  LiftedShell formulation(shell);
  const MassModel mass{shell, 0.5};
  // Without moving, this height costs material; the shell's lift buys it for nothing, so all stays full.
  std::vector<double> full(formulation.num_variables(), 1.0);
  full.back() = 0;
  const Task still{Heaviest(0.5), formulation, mass, test_device()};
  const Moments whole = still.total(full);
  const double lift = 0.1, height = (whole[SZ] + lift * shell[S1]) / whole[S1];
  const Heaviest problem(height);
  const Task task{problem, formulation, mass, test_device()};
  const SolverEntry& ipopt = find_solver("ipopt", "voxel");
  EXPECT_NO_THROW(require_form(ipopt, formulation));
  const Outcome outcome = solve(ipopt, task, {});
  ASSERT_TRUE(outcome.converged()) << outcome.message;
  EXPECT_EQ(outcome.settings.at("hessian_approximation"), "limited-memory")
      << "there are first derivatives alone";
  EXPECT_NEAR(outcome.x.back(), lift, 1e-4);
  EXPECT_NEAR(outcome.moments[S1], whole[S1], 1e-4 * whole[S1]);
  EXPECT_LE(outcome.violation, 1e-8);
}

TEST(MovingVariables, HaveNoExactHessian) {
  const Moments shell = box_moments({0, 0, 0.6}, {0.5, 0.5, 0.8});
  LiftedShell formulation(shell);
  const Heaviest problem(0.6);
  SolverOptions options;
  options.own = solvers().find("ipopt").read({{"hessian_approximation", "exact"}});
  EXPECT_THROW(
      (void)solve(find_solver("ipopt", "voxel"), {problem, formulation, {shell, 1}, test_device()}, options),
      InputError);
  EXPECT_THROW(require_form(find_solver("moment", "quadric"), formulation), InputError);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
