// second_order_test.cpp - is what a solve ends with a strict minimum? Against closed forms and differences.
#include "solve/second_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "domain/exact.hpp"
#include "domain/test_bodies.hpp"
#include "formulation/quadric.hpp"
#include "problem/balance.hpp"
#include "problem/spin.hpp"
#include "solve/certified_cases.hpp"
#include "solve/dual.hpp"
#include "solve/test_tasks.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Answer = LocalMinimum::Answer;

/// Minimise szz + beta sx^2 / 2 with a given mass. Symmetric in x, so filling from below is stationary
/// whatever beta; with a beta that pays for leaning it is a saddle.
class Leaning final : public RowsProblem {
 public:
  Leaning(double mass, double beta) : RowsProblem(Goal::value, Filling::segment), beta_(beta) {
    add("s1 = mass", Moments::Unit(S1), mass, mass);
  }
  [[nodiscard]] double value(const Moments& s) const override { return s[SZZ] + beta_ * s[SX] * s[SX] / 2; }
  [[nodiscard]] Moments gradient(const Moments& s) const override {
    return Moments::Unit(SZZ) + beta_ * s[SX] * Moments::Unit(SX);
  }
  [[nodiscard]] Matrix10 hessian(const Moments&) const override {
    return beta_ * Moments::Unit(SX) * Moments::Unit(SX).transpose();
  }

 private:
  double beta_;
};

constexpr double mass = 0.3;

/// -ds_x/dq_x where the box of BoxDomain is filled to mass 0.3: q = z^2 - top^2 has the slope 2 top, and the
/// columns stand at 1/16, 3/16, 5/16 to either side in four rows.
double lean_of_box() {
  constexpr double top = BoxDomain::base + mass / BoxDomain::area, h = BoxDomain::h;
  return h * h * 4 * 2 * (1 + 9 + 25) / 256.0 / (2 * top);
}

Rays box_rays() { return rays_of(BoxDomain::columns()); }

struct Solved {
  Outcome outcome;
  std::unique_ptr<Formulation> way;
};

Solved solve_on(const Rays& domain, const Problem& problem, const MassModel& model,
                const SolverOptions& options = {}) {
  auto way = make_quadric(domain, test_device());
  Outcome outcome = solve_with_moments({problem, *way, model, test_device()}, options);
  return {std::move(outcome), std::move(way)};
}

TEST(SecondOrder, GivesTheEigenvalueOfABoxThatMayLean) {
  for (const double share : {-0.5, -0.9, -0.999, -1.1, -3.0}) {
    SCOPED_TRACE(share);
    const Leaning problem(mass, share / lean_of_box());
    const Outcome outcome = solve_on(box_rays(), problem, {}).outcome;
    ASSERT_EQ(outcome.termination, Termination::optimal) << outcome.message;
    ASSERT_TRUE(outcome.local_minimum);
    const LocalMinimum& minimum = *outcome.local_minimum;
    EXPECT_EQ(minimum.strict, share > -1 ? Answer::yes : Answer::no) << minimum.text();
    EXPECT_NEAR(minimum.smallest, 1 + share, 1e-9);
    // On 24 columns of one height: 1, x, y, xy, xx, yy, less the mass.
    EXPECT_EQ(minimum.dimension, 5);
    // It leans, and does nothing else; at one height x and x z are the same.
    Moments lean = minimum.direction;
    lean[SX] = lean[SXZ] = 0;
    EXPECT_LE(lean.norm(), 1e-6 * minimum.direction.norm());
  }
}

TEST(SecondOrder, IsUndecidedWhereTheMinimumIsNotIsolated) {
  // Leaning a little costs nothing in the second order.
  const Outcome outcome = solve_on(box_rays(), Leaning(mass, -1 / lean_of_box()), {}).outcome;
  ASSERT_TRUE(outcome.local_minimum);
  EXPECT_EQ(outcome.local_minimum->strict, Answer::undecided) << outcome.local_minimum->text();
  EXPECT_NEAR(outcome.local_minimum->smallest, 0, 1e-9);
  EXPECT_NE(outcome.local_minimum->text().find("not isolated"), std::string::npos);
}

TEST(SecondOrder, IsOneOfALinearObjective) {
  const Outcome outcome = solve_on(box_rays(), LowestMass(mass), {}).outcome;
  ASSERT_TRUE(outcome.local_minimum);
  EXPECT_EQ(outcome.local_minimum->strict, Answer::yes) << outcome.local_minimum->text();
  EXPECT_NEAR(outcome.local_minimum->smallest, 1, 1e-12);
  EXPECT_EQ(outcome.local_minimum->dimension, 3);  // less mass, sx and sy
}

TEST(SecondOrder, IsUndecidedOfAPlaneAlongTheRays) {
  // Beside the middle of a box the plane is upright and holds a whole layer of columns (moment_test.cpp).
  const Case box(body_of(box_mesh({-0.6, -0.45, 0}, {0.6, 0.45, 0.926})), 24);
  const double middle = centre_of_mass(box.mass.total(box.domain.interior))[2];
  const Balance problem({0.03, 0, middle}, std::nullopt);
  const Outcome outcome = solve_on(rays_of(box.domain), problem, box.mass).outcome;
  ASSERT_TRUE(outcome.local_minimum) << outcome.message;
  EXPECT_EQ(outcome.local_minimum->strict, Answer::undecided);
  EXPECT_NE(outcome.local_minimum->text().find("along the rays"), std::string::npos)
      << outcome.local_minimum->text();
}

TEST(SecondOrder, HasNoTangentSpaceAtACorner) {
  // Lowest is empty: no ray is cut, and every filling costs in the first order.
  const RowsProblem problem(Goal::value, Filling::segment);
  const Outcome outcome = solve_on(box_rays(), problem, {}).outcome;
  ASSERT_TRUE(outcome.local_minimum);
  EXPECT_EQ(outcome.local_minimum->text(), "yes, the tangent space is {0}");
  EXPECT_TRUE(std::isnan(outcome.local_minimum->smallest));
}

/// What f and q . s grow by on either side of the optimum when q changes by epsilon p and the rows are met.
struct Growth {
  double of_f, of_q;
};

class Around {
 public:
  Around(const Rays& domain, const Problem& problem, const MassModel& model)
      : problem_(problem),
        solved_(solve_on(domain, problem, model)),
        oracle_(*solved_.way->oracle(), model, 0) {
    q_ = problem.gradient(outcome().moments) + rows().matrix.transpose() * multipliers();
  }
  [[nodiscard]] const Outcome& outcome() const { return solved_.outcome; }
  [[nodiscard]] Growth along(const Moments& p, double epsilon) {
    Growth growth{0, 0};
    for (const double side : {-epsilon, epsilon}) {
      QuadraticModel model;
      model.linear = q_ + side * p;
      const DualPoint near = minimise_model(oracle_, model, rows(), {}, 1e-13);
      EXPECT_LE(near.residual, 1e-13);
      growth.of_f += problem_.value(near.s) - outcome().objective;
      growth.of_q += q_.dot(near.s - outcome().moments);
    }
    return growth;
  }

 private:
  [[nodiscard]] Rows rows() const { return rows_of(problem_.constraints(), false); }
  [[nodiscard]] Eigen::VectorXd multipliers() const {
    const auto& m = outcome().multipliers;
    return Eigen::Map<const Eigen::VectorXd>(m.data(), static_cast<Eigen::Index>(m.size()));
  }
  const Problem& problem_;
  Solved solved_;
  TotalSupport oracle_;
  Moments q_;
};

TEST(SecondOrder, IsTheLeastShareOfTheGrowthOfQThatFHasNearby) {
  const Case leaning = top(0.02, 24);
  for (const double lambda : {0.0, 1.0}) {
    const Spin problem({.lambda = lambda});
    Around around(rays_of(leaning.domain), problem, leaning.mass);
    ASSERT_TRUE(around.outcome().local_minimum) << around.outcome().message;
    const LocalMinimum& minimum = *around.outcome().local_minimum;
    EXPECT_EQ(minimum.strict, Answer::yes);
    EXPECT_EQ(minimum.dimension, 5);  // ten, less the scale of q and four rows
    // Rays that start or end to be cut between the two sides are what differences are off by. Of shorter
    // steps round-off is: at 1e-5, q . s grows by 1e-13, and rows missed by 4e-15 cost multipliers of 12 as
    // much.
    constexpr double kinks = 2e-3;
    for (const double epsilon : {1e-2, 1e-3}) {
      const Growth least = around.along(minimum.direction / minimum.direction.norm(), epsilon);
      EXPECT_NEAR(least.of_f / least.of_q, minimum.smallest, kinks) << epsilon;
    }
    Random random(5);
    double found = 10;
    for (int i = 0; i < 40; ++i) {
      Moments p;
      for (double& x : p) x = uniform(random, -1, 1);
      const Growth growth = around.along(p, 1e-3);
      ASSERT_GT(growth.of_q, 0);
      EXPECT_GE(growth.of_f / growth.of_q, minimum.smallest - kinks);
      found = std::min(found, growth.of_f / growth.of_q);
    }
    EXPECT_GT(found, minimum.smallest) << "random directions miss the least";
  }
}

/// Two equal plates above each other, as one body, with a domain that is symmetric to round-off: rays cut
/// exactly at a wall of one cell.
struct Plates {
  explicit Plates(double apart) {
    TriangleMesh both = box_mesh({-0.7, -0.6, 0}, {0.7, 0.6, 0.3});
    const TriangleMesh other = box_mesh({-0.7, -0.6, 0.3 + apart}, {0.7, 0.6, 0.6 + apart});
    const auto offset = static_cast<std::uint32_t>(both.vertices.size());
    both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.triangles)
      both.triangles.push_back({a + offset, b + offset, c + offset});
    const Body body = body_of(both);
    GridSpec grid;
    grid.resolution = 32;
    const ExactColumns domain = make_exact(body, grid, {1, Wall::cells});
    rays = rays_of(domain);
    mass = hollowed(body, domain.interior);
    middle = 0.3 + apart / 2;
  }
  Rays rays;
  MassModel mass;
  double middle;
};

TEST(SecondOrder, TellsASaddleFromAMinimumOfAFamilyThatForks) {
  // Even, both plates are alike. Far enough apart it pays to hollow one more than the other, and what was the
  // minimum has become a saddle between two.
  const Spin problem({});
  double before = 1;
  for (const double apart : {0.05, 0.1, 0.2, 0.4, 0.8}) {
    SCOPED_TRACE(apart);
    const bool forked = apart > 0.3;
    const Plates plates(apart);
    const Outcome even = solve_on(plates.rays, problem, plates.mass).outcome;
    ASSERT_EQ(even.termination, Termination::optimal) << even.message;
    EXPECT_NEAR(centre_of_mass(even.moments)[2], plates.middle, 1e-6) << "not even";
    ASSERT_TRUE(even.local_minimum);
    EXPECT_EQ(even.local_minimum->strict, forked ? Answer::no : Answer::yes) << even.local_minimum->text();
    EXPECT_LT(even.local_minimum->smallest, before) << "the eigenvalue falls through 0";
    before = even.local_minimum->smallest;

    SolverOptions upper;  // from the upper plate alone
    upper.from.assign(10, 0.0);
    upper.from[S1] = plates.middle;
    upper.from[SZ] = -1;
    const Outcome uneven = solve_on(plates.rays, problem, plates.mass, upper).outcome;
    ASSERT_EQ(uneven.termination, Termination::optimal) << uneven.message;
    ASSERT_TRUE(uneven.local_minimum);
    EXPECT_EQ(uneven.local_minimum->strict, Answer::yes) << uneven.local_minimum->text();
    if (forked)
      EXPECT_LT(uneven.objective, even.objective - 1e-3);
    else
      EXPECT_NEAR(uneven.objective, even.objective, 1e-9);
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
