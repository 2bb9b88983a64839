// margin_test.cpp - the margin as the goal, and problems solved in sequence.
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <string>

#include "solve/rows.hpp"
#include "solve/ways.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double whole = BoxDomain::area * BoxDomain::height;  // mass of the domain
const Moments mass_form = Moments::Unit(S1), height_form = Moments::Unit(SZ);

class MarginOf : public testing::TestWithParam<Way> {
 protected:
  Outcome solve(const RowsProblem& rows) {
    const auto f =
        make_formulation(GetParam().formulation, BoxDomain::columns(), rows.traits(), {}, test_device());
    const MassModel mass;
    const Task task{rows, *f, mass, test_device()};
    const Outcome outcome =
        kreisel::core::solve(default_solver(GetParam().formulation), task, options_of(GetParam()));
    gap_ = gap_of(task, outcome, 1);
    EXPECT_LT(gap_, 1e-3) << "or the solver stopped far from what it calls optimal";
    // The smallest t: what the worst row is missed by, or, negative, what the tightest has to spare.
    const LinearConstraints& c = rows.constraints();
    const Eigen::VectorXd value = c.matrix * outcome.moments;
    margin_ = std::max((c.lower - value).maxCoeff(), (value - c.upper).maxCoeff());
    return outcome;
  }
  double gap_ = 0, margin_ = 0;
};

TEST_P(MarginOf, ARowOutOfReachIsTheLeastMiss) {
  const Outcome outcome =
      solve(RowsProblem(Goal::margin).add("mass", mass_form, whole + 0.125, RowsProblem::free));
  EXPECT_NEAR(margin_, 0.125, gap_);
  EXPECT_EQ(outcome.violation, margin_);
  EXPECT_EQ(to_string(outcome.termination), "infeasible");
  EXPECT_EQ(outcome.message, "the constraints are missed by 1.25e-01 at the least");
}

TEST_P(MarginOf, ARowThatIsMetIsMinusWhatItCanSpare) {
  const Outcome outcome =
      solve(RowsProblem(Goal::margin).add("mass", mass_form, whole - 0.125, RowsProblem::free));
  EXPECT_NEAR(margin_, -0.125, gap_);
  EXPECT_EQ(outcome.violation, 0);
  EXPECT_EQ(to_string(outcome.termination), "optimal") << outcome.message;
}

TEST_P(MarginOf, AnEquationThatCanBeMetIsZero) {
  const Outcome outcome = solve(RowsProblem(Goal::margin).add("mass", mass_form, whole / 3, whole / 3));
  EXPECT_NEAR(margin_, 0, std::min(gap_, 1e-6)) << "the limit of what counts as met";
  EXPECT_EQ(to_string(outcome.termination), "optimal") << outcome.message;
}

TEST_P(MarginOf, RowsAtOddsShareTheMiss) {
  const Outcome outcome = solve(RowsProblem(Goal::margin)
                                    .add("more", mass_form, 0.3, RowsProblem::free)
                                    .add("less", mass_form, -RowsProblem::free, 0.1));
  EXPECT_NEAR(margin_, 0.1, gap_);
  EXPECT_NEAR(outcome.moments[S1], 0.2, gap_);
  EXPECT_EQ(to_string(outcome.termination), "infeasible");
}

TEST_P(MarginOf, ARangeIsBestInItsMiddle) {
  const Outcome outcome = solve(RowsProblem(Goal::margin).add("mass", mass_form, 0.05, 0.25));
  EXPECT_NEAR(margin_, -0.1, gap_);
  EXPECT_NEAR(outcome.moments[S1], 0.15, gap_);
}

INSTANTIATE_TEST_SUITE_P(Ways, MarginOf, testing::ValuesIn(ways()),
                         [](const auto& p) { return name_of(p.param); });

/// `left` more problems come after this one; its value tells which it is.
class Countdown final : public Problem {
 public:
  explicit Countdown(int left) : left_(left) { constraints_.matrix.resize(0, 10); }
  [[nodiscard]] std::string_view name() const override { return "countdown"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] double value(const Moments& s) const override { return 100 * left_ + s[S1]; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return Moments::Zero(); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Zero(); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }
  [[nodiscard]] std::unique_ptr<Problem> next(const Moments&) const override {
    return left_ > 0 ? std::make_unique<Countdown>(left_ - 1) : nullptr;
  }

 private:
  int left_;
  LinearConstraints constraints_;
};

/// Stands in for a solver: each call adds one to the variable that it starts from, and may fail, or be
/// stopped.
struct Script {
  static inline int calls = 0, fails_at = 0, stopped_at = 0;
  static inline std::stop_source stop;
  static Outcome solve(const Task& task, const SolverOptions& options) {
    ++calls;
    Outcome outcome;
    if (calls == stopped_at) stop.request_stop();
    outcome.termination = calls == fails_at            ? Termination::failed
                          : task.stop.stop_requested() ? Termination::interrupted
                                                       : Termination::optimal;
    outcome.message = "call";
    outcome.x = {options.from.empty() ? 1 : options.from.front() + 1};
    outcome.moments[S1] = outcome.x.front();
    outcome.objective = task.problem.value(outcome.moments);
    outcome.iterations = calls;
    outcome.kernel_seconds = 0.25;
    outcome.solve_seconds = 0.5;
    outcome.evaluations = {1, 2, 3, 4, 5};
    outcome.history = {{calls, 0, 0, 0, 0, 0, 0}};
    return outcome;
  }
};

Outcome run(int left, int fails_at = 0, int stopped_at = 0) {
  Script::calls = 0;
  Script::fails_at = fails_at;
  Script::stopped_at = stopped_at;
  Script::stop = {};
  const Countdown problem(left);
  const auto f = make_formulation("rayrep", BoxDomain::columns(), {}, {}, test_device());
  const MassModel mass;
  return solve({"script", "", Script::solve, {.derivatives = true}},
               {problem, *f, mass, test_device(), Script::stop.get_token()}, {});
}

TEST(SolveInSequence, IsStoppedInAnyOfItsSteps) {
  for (const int step : {1, 3}) {
    EXPECT_EQ(run(5, 0, step).termination, Termination::interrupted) << step;
    EXPECT_EQ(Script::calls, step) << "no other step is begun";
  }
}

TEST(SolveInSequence, AddsUpWhatItCostAndGoesOnFromWhereItWas) {
  const Outcome outcome = run(3);
  EXPECT_EQ(outcome.steps, 4);
  EXPECT_EQ(outcome.x, std::vector<double>{4});
  EXPECT_EQ(outcome.iterations, 1 + 2 + 3 + 4);
  EXPECT_EQ(outcome.kernel_seconds, 1);
  EXPECT_EQ(outcome.solve_seconds, 2);
  EXPECT_EQ(outcome.evaluations.objective, 4);
  EXPECT_EQ(outcome.evaluations.gradient, 8);
  EXPECT_EQ(outcome.evaluations.constraints, 12);
  EXPECT_EQ(outcome.evaluations.jacobian, 16);
  EXPECT_EQ(outcome.evaluations.hessian, 20);
  ASSERT_EQ(outcome.history.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(outcome.history[static_cast<std::size_t>(i)].iteration, i + 1);
  EXPECT_EQ(outcome.objective, 304) << "of the problem that was asked";
  EXPECT_EQ(outcome.message, "call, 4 steps");
}

TEST(SolveInSequence, OneProblemIsOneStepAndSaysNothingOfIt) {
  const Outcome outcome = run(0);
  EXPECT_EQ(outcome.steps, 1);
  EXPECT_EQ(outcome.message, "call");
  EXPECT_EQ(outcome.objective, 1);
}

TEST(SolveInSequence, StopsAtAStepThatFails) {
  const Outcome outcome = run(5, 3);
  EXPECT_EQ(outcome.steps, 3);
  EXPECT_EQ(to_string(outcome.termination), "failed");
  EXPECT_EQ(run(5, 1).steps, 1);
}

TEST(SolveInSequence, GivesUpAfterFiftySteps) { EXPECT_EQ(run(1000).steps, 50); }

}  // namespace THIS_FILE
}  // namespace kreisel::core
