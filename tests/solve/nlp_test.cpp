#include "solve/nlp.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "problem/spin.hpp"
#include "solve/nonlinear_problem.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A TNLP as plain functions of dense vectors and matrices.
class Dense {
 public:
  explicit Dense(Ipopt::SmartPtr<Nlp> nlp) : nlp_(std::move(nlp)) {
    Ipopt::TNLP::IndexStyleEnum style{};
    EXPECT_TRUE(nlp_->get_nlp_info(n_, m_, jac_, hess_, style));
    EXPECT_EQ(style, Ipopt::TNLP::C_STYLE);
    for (auto* v : {&x_l, &x_u, &start}) v->setZero(n_);
    for (auto* v : {&g_l, &g_u}) v->setZero(m_);
    EXPECT_TRUE(nlp_->get_bounds_info(n_, x_l.data(), x_u.data(), m_, g_l.data(), g_u.data()));
    EXPECT_TRUE(
        nlp_->get_starting_point(n_, true, start.data(), false, nullptr, nullptr, m_, false, nullptr));
  }

  [[nodiscard]] int n() const { return n_; }
  [[nodiscard]] int m() const { return m_; }
  [[nodiscard]] bool has_hessian() const { return hess_ > 0; }

  double f(const VectorXd& x) const {
    double value = 0;
    EXPECT_TRUE(nlp_->eval_f(n_, x.data(), true, value));
    return value;
  }
  VectorXd gradient(const VectorXd& x) const {
    VectorXd value(n_);
    EXPECT_TRUE(nlp_->eval_grad_f(n_, x.data(), true, value.data()));
    return value;
  }
  VectorXd g(const VectorXd& x) const {
    VectorXd value(m_);
    EXPECT_TRUE(nlp_->eval_g(n_, x.data(), true, m_, value.data()));
    return value;
  }
  MatrixXd jacobian(const VectorXd& x) const {
    std::vector<int> row(jac_, -1), column(jac_, -1);
    std::vector<double> value(jac_);
    EXPECT_TRUE(nlp_->eval_jac_g(n_, x.data(), true, m_, jac_, row.data(), column.data(), nullptr));
    EXPECT_TRUE(nlp_->eval_jac_g(n_, x.data(), true, m_, jac_, nullptr, nullptr, value.data()));
    return gather(m_, row, column, value);
  }
  /// Symmetric, from the triangle that the form gives.
  MatrixXd hessian(const VectorXd& x, double factor, const VectorXd& lambda) const {
    std::vector<int> row(hess_, -1), column(hess_, -1);
    std::vector<double> value(hess_);
    EXPECT_TRUE(nlp_->eval_h(n_, x.data(), true, factor, m_, lambda.data(), true, hess_, row.data(),
                             column.data(), nullptr));
    EXPECT_TRUE(nlp_->eval_h(n_, x.data(), true, factor, m_, lambda.data(), true, hess_, nullptr, nullptr,
                             value.data()));
    for (int e = 0; e < hess_; ++e) EXPECT_GE(row[e], column[e]) << "one triangle only";
    const MatrixXd lower = gather(n_, row, column, value);
    return MatrixXd(lower.selfadjointView<Eigen::Lower>());
  }

  VectorXd x_l, x_u, g_l, g_u, start;

 private:
  [[nodiscard]] MatrixXd gather(int rows, const std::vector<int>& row, const std::vector<int>& column,
                                const std::vector<double>& value) const {
    MatrixXd dense = MatrixXd::Zero(rows, n_);
    for (std::size_t e = 0; e < value.size(); ++e) {
      const bool inside = row[e] >= 0 && row[e] < rows && column[e] >= 0 && column[e] < n_;
      EXPECT_TRUE(inside) << "entry " << e << " at " << row[e] << ", " << column[e];
      if (inside) dense(row[e], column[e]) += value[e];
    }
    return dense;
  }

  Ipopt::SmartPtr<Nlp> nlp_;
  int n_ = 0, m_ = 0, jac_ = 0, hess_ = 0;
};

enum class Form { direct, full, convex };

/// Finite bounds of Margin, below.
constexpr int margin_rows = 6;

/// Spin with equations alone, for its margin inequalities, equations and bounds on one side, or a row that is
/// not linear.
enum class Asked { spin, margin, nonlinear };

struct Kind {
  Form form;
  std::string formulation;
  SettingTexts settings;
  Asked asked = Asked::spin;
  Filling filling = Filling::segment;
};

std::string name_of(const Kind& kind) {
  std::string name = kind.form == Form::direct ? "direct_" : kind.form == Form::full ? "full_" : "convex_";
  name += kind.formulation;
  for (const auto& [key, value] : kind.settings) name += "_" + value;
  if (kind.filling == Filling::from_below) name += "_from_below";
  return name + (kind.asked == Asked::margin      ? "_margin"
                 : kind.asked == Asked::nonlinear ? "_nonlinear"
                                                  : "");
}

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << name_of(kind); }

/// Four rows of every kind, on moments of every order: an equation, a range, one bound above, one below.
class Margin final : public Problem {
 public:
  Margin() {
    constraints_.matrix.setZero(4, 10);
    constraints_.matrix.row(0) << -0.2, 1, 0, 0, 0, 0, 0, 0, 0, 0;
    constraints_.matrix.row(1) << 0.1, 0, 0, 0.5, 1, 0, 0, 0, 0, 0;
    constraints_.matrix.row(2) << 0, 0.3, -1, 0, 0, 0, 0, 0, 0, 2;
    constraints_.matrix.row(3) << 1, 0, 0, 0, 0, 0, 1, 0, -1, 0;
    constraints_.lower = Eigen::Vector4d(0.1, -0.2, -infinity, 0.4);
    constraints_.upper = Eigen::Vector4d(0.1, 0.3, 0.7, infinity);
    constraints_.names = {"equation", "range", "above", "below"};
  }
  [[nodiscard]] std::string_view name() const override { return "margin"; }
  [[nodiscard]] Convexity convexity() const override { return Convexity::linear; }
  [[nodiscard]] Goal goal() const override { return Goal::margin; }
  [[nodiscard]] double value(const Moments&) const override { return 7; }
  [[nodiscard]] Moments gradient(const Moments&) const override { return Moments::Constant(7); }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override { return Matrix10::Constant(7); }
  [[nodiscard]] const LinearConstraints& constraints() const override { return constraints_; }
  [[nodiscard]] Verdict verify(const Moments&, double) const override { return {}; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  LinearConstraints constraints_;
};

class NlpOf : public testing::TestWithParam<Kind> {
 protected:
  NlpOf()
      : formulation_(make_formulation(GetParam().formulation, BoxDomain::columns(), {GetParam().filling},
                                      GetParam().settings, test_device())),
        nlp_(make(GetParam().form)) {}

  [[nodiscard]] Dense make(Form form) {
    const Task task{asked(), *formulation_, mass_, test_device()};
    std::vector<double> start = formulation_->start(Start::middle);
    return Dense(form == Form::direct ? make_direct_nlp(task, std::move(start))
                                      : make_lifted_nlp(task, std::move(start), form == Form::convex));
  }

  [[nodiscard]] const Problem& asked() const {
    if (GetParam().asked == Asked::nonlinear) return circle_;
    return margin() ? static_cast<const Problem&>(margin_) : spin_;
  }
  [[nodiscard]] bool margin() const { return GetParam().asked == Asked::margin; }
  [[nodiscard]] bool lifted() const { return GetParam().form != Form::direct; }
  [[nodiscard]] int variables() const { return static_cast<int>(formulation_->num_variables()); }

  /// Random x within its bounds and in order; lifted moments near, but not at, s(x).
  VectorXd random_point(Random& random) {
    const int n = variables();
    VectorXd x(nlp_.n());
    for (int i = 0; i < n; ++i) x[i] = uniform(random, nlp_.x_l[i], nlp_.x_u[i]);
    if (formulation_->name() == "rayrep" && GetParam().filling != Filling::from_below)
      for (int i = 0; i < n; i += 2)
        if (x[i] > x[i + 1]) std::swap(x[i], x[i + 1]);
    if (margin()) x[nlp_.n() - 1] = uniform(random, -1, 1);
    if (lifted()) {
      const Moments s = mass_.total(formulation_->moments({x.data(), formulation_->num_variables()}));
      for (int k = 0; k < 10; ++k) x[n + k] = s[k] + uniform(random, -0.01, 0.01);
    }
    return x;
  }

  /// Steps of differences: a thousandth of a variable's reach and its cube root of roundoff, so that s, which
  /// divides f, moves by a tiny part of itself.
  [[nodiscard]] double step(int i) const {
    const double u = test_device().unit_roundoff();
    return std::cbrt(u) * (i < variables() ? 1.0 : 0.25);
  }

  /// Central differences are good to u^(2/3) of the values that go in, times the ratio of third derivatives
  /// to values: f is a quotient of moments of order 1/4, so a thousand.
  [[nodiscard]] static double tolerance(double size) {
    return 1000 * std::pow(test_device().unit_roundoff(), 2.0 / 3) * size;
  }

  MatrixXd differences(const VectorXd& x, const std::function<VectorXd(const VectorXd&)>& value) const {
    MatrixXd result;
    for (int i = 0; i < x.size(); ++i) {
      VectorXd up = x, down = x;
      up[i] += step(i);
      down[i] -= step(i);
      const VectorXd column = (value(up) - value(down)) / (up[i] - down[i]);
      if (i == 0) result.resize(column.size(), x.size());
      result.col(i) = column;
    }
    return result;
  }

  const Spin spin_{{.lambda = 0.3, .gamma_i = 1}};
  const Margin margin_;
  const WithinACircle circle_{0.9, 0.1};
  MassModel mass_{box_moments({0.02, -0.01, 0.6}, {1.5, 1.2, 0.75}), 0.8};
  std::unique_ptr<Formulation> formulation_;
  Dense nlp_;
};

void expect_same(const MatrixXd& got, const MatrixXd& want, double tolerance) {
  ASSERT_EQ(got.rows(), want.rows());
  ASSERT_EQ(got.cols(), want.cols());
  for (int r = 0; r < got.rows(); ++r)
    for (int c = 0; c < got.cols(); ++c) EXPECT_NEAR(got(r, c), want(r, c), tolerance) << r << ", " << c;
}

TEST_P(NlpOf, GradientMatchesCentralDifferences) {
  Random random(61);
  const VectorXd x = random_point(random);
  const MatrixXd want = differences(x, [&](const VectorXd& at) { return VectorXd::Constant(1, nlp_.f(at)); });
  const VectorXd got = nlp_.gradient(x);
  EXPECT_GT(got.cwiseAbs().maxCoeff(), 100 * tolerance(std::abs(nlp_.f(x))))
      << "a gradient too small to test";
  expect_same(got.transpose(), want, tolerance(std::abs(nlp_.f(x))));
}

TEST_P(NlpOf, JacobianMatchesCentralDifferences) {
  Random random(62);
  const VectorXd x = random_point(random);
  const MatrixXd want = differences(x, [&](const VectorXd& at) { return nlp_.g(at); });
  expect_same(nlp_.jacobian(x), want, tolerance(1));
}

TEST_P(NlpOf, HessianMatchesCentralDifferencesOfTheLagrangiansGradient) {
  if (!lifted()) {
    EXPECT_FALSE(nlp_.has_hessian());
    return;
  }
  Random random(63);
  const VectorXd x = random_point(random);
  const double factor = 0.7;
  VectorXd lambda(nlp_.m());
  for (int i = 0; i < lambda.size(); ++i) lambda[i] = uniform(random, -1, 1);
  lambda[SZZ] = -1;  // curves upper ends down, so that there is something to raise
  const Dense full = make(Form::full);
  MatrixXd want = differences(x, [&](const VectorXd& at) -> VectorXd {
    return factor * full.gradient(at) + full.jacobian(at).transpose() * lambda;
  });
  const int n = variables();
  int raised = 0;
  if (GetParam().form == Form::convex)
    for (int i = 0; i < n; ++i) {
      raised += want(i, i) < 0;
      want(i, i) = std::max(want(i, i), 0.0);
    }
  const MatrixXd got = nlp_.hessian(x, factor, lambda);
  expect_same(got, want, tolerance(full.gradient(x).cwiseAbs().maxCoeff() + 1));
  if (GetParam().form == Form::convex) {
    EXPECT_GE(got.diagonal().head(n).minCoeff(), 0);
    if (formulation_->name() == "rayrep") {
      EXPECT_GT(raised, 0) << "nothing to raise, nothing tested";
    }
    // Nothing else differs from the full form.
    MatrixXd clipped = full.hessian(x, factor, lambda);
    clipped.diagonal().head(n) = clipped.diagonal().head(n).cwiseMax(0.0);
    EXPECT_EQ(got, clipped);
  }
}

TEST_P(NlpOf, StartsWhereAskedAndLiftedMomentsBeginConsistent) {
  const auto start = formulation_->start(Start::middle);
  for (int i = 0; i < variables(); ++i) EXPECT_EQ(nlp_.start[i], start[static_cast<std::size_t>(i)]);
  ASSERT_EQ(nlp_.n(), variables() + (lifted() ? 10 : 0) + (margin() ? 1 : 0));
  const VectorXd g = nlp_.g(nlp_.start);
  if (margin()) {
    // t is as small as the start allows: every row is met, one of them just so.
    const VectorXd slack = (nlp_.g_u - g).cwiseMin(g - nlp_.g_l).segment(lifted() ? 10 : 0, margin_rows);
    EXPECT_NEAR(slack.minCoeff(), 0, 16 * 0x1p-53) << "t moved across three terms of order one";
    EXPECT_LE(nlp_.x_l[nlp_.n() - 1], -1e19);
    EXPECT_GE(nlp_.x_u[nlp_.n() - 1], 1e19);
    EXPECT_EQ(nlp_.f(nlp_.start), nlp_.start[nlp_.n() - 1]) << "t is the objective";
  }
  if (!lifted()) return;
  EXPECT_EQ(g.head(10).cwiseAbs().maxCoeff(), 0) << "s = s(x) at the start";
  EXPECT_EQ(nlp_.g_l.head(10).cwiseAbs().maxCoeff() + nlp_.g_u.head(10).cwiseAbs().maxCoeff(), 0);
  EXPECT_LE(nlp_.x_l.segment(variables(), 10).maxCoeff(), -1e19) << "Ipopt's infinity";
  EXPECT_GE(nlp_.x_u.segment(variables(), 10).minCoeff(), 1e19);
}

class NlpOfMargin : public NlpOf {};

TEST_P(NlpOfMargin, ARowForEveryFiniteBoundHoldsWhenItDoes) {
  Random random(65);
  VectorXd x = random_point(random);
  const int skip = lifted() ? 10 : 0;
  ASSERT_EQ(nlp_.m(), skip + margin_rows + static_cast<int>(formulation_->own_constraints().lower.size()));
  const Moments s = lifted() ? Moments(x.segment(variables(), 10))
                             : mass_.total(formulation_->moments({x.data(), formulation_->num_variables()}));
  const LinearConstraints& c = margin_.constraints();
  const VectorXd value = c.matrix * s;
  const double least = std::max((c.lower - value).maxCoeff(), (value - c.upper).maxCoeff());
  for (const double t : {least - 1e-9, least + 1e-9}) {
    x[nlp_.n() - 1] = t;
    const VectorXd g = nlp_.g(x).segment(skip, margin_rows);
    const bool met = ((g - nlp_.g_l.segment(skip, margin_rows)).array() >= 0).all() &&
                     ((nlp_.g_u.segment(skip, margin_rows) - g).array() >= 0).all();
    EXPECT_EQ(met, t > least) << "lower - t <= C s <= upper + t";
  }
}

class NlpOfRows : public NlpOf {};

TEST_P(NlpOfRows, ConstraintRowsAreTheProblemsAndTheFormulations) {
  Random random(64);
  const VectorXd x = random_point(random);
  const VectorXd g = nlp_.g(x);
  const int skip = lifted() ? 10 : 0;
  const Moments s = lifted() ? Moments(x.tail(10))
                             : mass_.total(formulation_->moments({x.data(), formulation_->num_variables()}));
  const int rays = formulation_->own_constraints().lower.empty() ? 0 : variables() / 2;
  const LinearConstraints& linear = asked().constraints();
  const auto lines = static_cast<int>(linear.matrix.rows());
  const Nonlinear* more = asked().nonlinear();
  const int rows = lines + (more ? static_cast<int>(more->lower().size()) : 0);
  ASSERT_EQ(rows, GetParam().asked == Asked::spin ? 4 : 2);
  ASSERT_EQ(g.size(), skip + rows + rays);
  for (int row = 0; row < lines; ++row) {
    EXPECT_EQ(g[skip + row], linear.matrix.row(row).dot(s));
    EXPECT_EQ(nlp_.g_l[skip + row], linear.lower[row]);
    EXPECT_EQ(nlp_.g_u[skip + row], linear.upper[row]);
  }
  const MomentIndex zero[] = {SX, SY, SXZ, SYZ};
  for (int row = 0; row < (more ? 0 : 4); ++row) {
    EXPECT_EQ(g[skip + row], s[zero[row]]);
    EXPECT_EQ(nlp_.g_l[skip + row], 0);
    EXPECT_EQ(nlp_.g_u[skip + row], 0);
  }
  for (int row = lines; row < rows; ++row) {
    EXPECT_EQ(g[skip + row], more->rows(s, {})[row - lines]);
    EXPECT_LE(nlp_.g_l[skip + row], -1e19) << "infinite";
    EXPECT_EQ(nlp_.g_u[skip + row], more->upper()[row - lines]);
  }
  for (int i = 0; i < rays; ++i) {
    EXPECT_EQ(g[skip + rows + i], x[2 * i + 1] - x[2 * i]);
    EXPECT_EQ(nlp_.g_l[skip + rows + i], 0);
    EXPECT_GE(nlp_.g_u[skip + rows + i], 1e19);
  }
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (const Form form : {Form::direct, Form::full, Form::convex}) {
    all.push_back({form, "voxel", {}});
    all.push_back({form, "rayrep", {{"bounds", "midpoint"}}});
    all.push_back({form, "rayrep", {{"bounds", "ordered"}, {"unit", "body"}}});
    all.push_back({form, "rayrep", {}, Asked::spin, Filling::from_below});
    for (const Filling filling : {Filling::segment, Filling::from_below})
      all.push_back({form, "rayrep", {}, Asked::margin, filling});
    all.push_back({form, "rayrep", {{"bounds", "ordered"}}, Asked::margin});
    for (const Asked asked : {Asked::margin, Asked::nonlinear}) all.push_back({form, "voxel", {}, asked});
    all.push_back({form, "rayrep", {}, Asked::nonlinear});
  }
  return all;
}

/// Those of the kinds whose objective is the margin, or the others.
std::vector<Kind> kinds_of(bool margin) {
  std::vector<Kind> some = kinds();
  std::erase_if(some, [&](const Kind& kind) { return (kind.asked == Asked::margin) != margin; });
  return some;
}

constexpr auto named = [](const auto& p) { return name_of(p.param); };

INSTANTIATE_TEST_SUITE_P(Forms, NlpOf, testing::ValuesIn(kinds()), named);
INSTANTIATE_TEST_SUITE_P(Forms, NlpOfMargin, testing::ValuesIn(kinds_of(true)), named);
INSTANTIATE_TEST_SUITE_P(Forms, NlpOfRows, testing::ValuesIn(kinds_of(false)), named);

}  // namespace THIS_FILE
}  // namespace kreisel::core
