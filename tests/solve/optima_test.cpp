// optima_test.cpp - stand, float and balance on a box, against optima found by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "problem/balance.hpp"
#include "problem/float.hpp"
#include "problem/stand.hpp"
#include "solve/ways.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double area = BoxDomain::area, bottom = BoxDomain::base, top = bottom + BoxDomain::height;

/// What is fixed: a mass of 0.2 at height 0.7, off the middle where the optimum is known for rays.
MassModel shell(const Vec3& centre = {0, 0, 0.7}) { return {0.2 * box_moments(centre, {1, 1, 1}), 0.75}; }

/// x and y of the rays of the domain.
std::vector<Vec2> rays() {
  std::vector<Vec2> at;
  const Columns& domain = BoxDomain::columns();
  for (const Interval& run : domain.intervals)
    at.emplace_back(domain.grid.centre(0, run.ix), domain.grid.centre(1, run.iy));
  return at;
}

/// Total moments when ray i is filled up to height(ray), by hand: s1, sx, sy, sz.
Eigen::Vector4d filled(const MassModel& mass, const std::function<double(const Vec2&)>& height) {
  Eigen::Vector4d s = mass.fixed.head<4>();
  for (const Vec2& at : rays()) {
    const double z = height(at), m = mass.contrast * BoxDomain::h * BoxDomain::h * (z - bottom);
    s += m * Eigen::Vector4d(1, at[0], at[1], (z + bottom) / 2);
  }
  return s;
}

/// The root of an increasing function.
double root(double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < 60; ++i) (f((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return low;
}

/// Segments over the middle half of each ray.
std::vector<double> half_full(const Bounds& bounds) {
  std::vector<double> x;
  for (std::size_t i = 0; i < bounds.lower.size(); ++i)
    x.push_back(std::lerp(bounds.lower[i], bounds.upper[i], i % 2 ? 0.75 : 0.25));
  return x;
}

class Optimum : public testing::TestWithParam<Way> {
 protected:
  Outcome solve(const Problem& problem, const MassModel& mass) {
    formulation_ =
        make_formulation(GetParam().formulation, BoxDomain::columns(), problem.traits(), {}, test_device());
    const Task task{problem, *formulation_, mass, test_device()};
    SolverOptions options = options_of(GetParam());
    // Half way between ordered bounds every segment is empty, and any that grows there may be on the wrong
    // side of the point: a local infeasibility, from which the convex model alone gets away.
    if (problem.traits().filling == Filling::either_end && !voxels() &&
        name_of(GetParam()) != "rayrep_convex")
      options.from = half_full(formulation_->bounds());
    const Outcome outcome = kreisel::core::solve(default_solver(GetParam().formulation), task, options);
    EXPECT_TRUE(outcome.termination == Termination::optimal || outcome.termination == Termination::acceptable)
        << outcome.message;
    gap_ = gap_of(task, outcome, 1);
    EXPECT_LT(gap_, 2e-3) << "or the solver stopped far from what it calls optimal";
    EXPECT_LE(outcome.violation, 1e-6);
    return outcome;
  }
  [[nodiscard]] static bool voxels() { return GetParam().formulation == "voxel"; }

  std::unique_ptr<Formulation> formulation_;
  double gap_ = 0;
};

TEST_P(Optimum, OfAFloatingBoxFillsItFromBelowUpToItsMass) {
  const MassModel mass = shell();
  const double fill = 0.65;
  const double total = mass.fixed[S1] + mass.contrast * area * fill;
  const Float problem({{0.5, 1, Vec3(0, 0, 0.3), 1, 1}, total, 1, 1});
  const Outcome outcome = solve(problem, mass);
  // Voxels: five whole layers and a fifth of the sixth, whose fill is spread over its height.
  const double part = fill - 5 * BoxDomain::h;
  const double sz =
      voxels() ? 5 * BoxDomain::h * (bottom + 2.5 * BoxDomain::h) + part * (bottom + 5.5 * BoxDomain::h)
               : fill * (bottom + fill / 2);
  EXPECT_NEAR(outcome.objective, (mass.fixed[SZ] + mass.contrast * area * sz) / total, gap_);
}

TEST_P(Optimum, OfAListingFloatIsCutByATiltedPlane) {
  if (voxels()) GTEST_SKIP() << "known for rays alone";
  const MassModel mass = shell({-0.05, 0.05, 0.7});
  const double total = mass.fixed[S1] + mass.contrast * area * 0.5;
  const Float problem({{0.5, 1, Vec3(0.01, 0.02, 0.3), 1, 1}, total, 1, 1});
  const Outcome outcome = solve(problem, mass);
  // Heights a + b . xy of least sum of squares for given sums of 1, x, y: the domain is centred and
  // symmetric.
  const double h2 = mass.contrast * BoxDomain::h * BoxDomain::h;
  Vec2 squares = Vec2::Zero();
  for (const Vec2& at : rays()) squares += at.cwiseProduct(at);
  const Vec2 slope = (Vec2(0.01, 0.02) * total - mass.fixed.segment<2>(SX)).cwiseQuotient(h2 * squares);
  const auto s = filled(mass, [&](const Vec2& at) { return bottom + 0.5 + slope.dot(at); });
  ASSERT_NEAR(s[SX], 0.01 * total, 1e-15);
  EXPECT_NEAR(outcome.objective, s[SZ] / total, gap_);
}

TEST_P(Optimum, OfAStandingBoxIsFilledUpToItsCentreOfMass) {
  const MassModel mass = shell();
  const Base base{hull_of({{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}}), 0, 1.25};
  const double a = mass.contrast * area, m = mass.fixed[S1];
  double want = 1;
  if (voxels()) {
    for (int k = 0; k <= BoxDomain::layers; ++k) {
      const double fill = k * BoxDomain::h;
      want = std::min(want, (mass.fixed[SZ] + a * fill * (bottom + fill / 2)) / (m + a * fill));
    }
  } else {
    // T^2 a / 2 + (m - a b) T + a b^2 / 2 = sz: the fill ends at the centre of mass T.
    const double p = m / a - bottom;
    want = -p + std::sqrt(p * p - bottom * bottom + 2 * mass.fixed[SZ] / a);
  }
  for (const auto& problem : {Stand(base, std::nullopt), Stand(base, 0.05)}) {
    const Outcome outcome = solve(problem, mass);
    EXPECT_NEAR(outcome.objective, want, gap_);
  }

  // The same is the steepest tilt, for the centre of mass stays in the middle by symmetry.
  const Outcome tilted = solve(MaxTilt(base, 0.3 / 0.7), mass);
  // tan = 0.3 / c, so an error in c counts 0.3 / c^2; a margin is a first moment, so counts 1 / (s1 c).
  EXPECT_NEAR(tilted.objective, -0.3 / want, (0.3 / want + 1 / mass.fixed[S1]) / want * gap_ + 1e-6);
  EXPECT_GE(tilted.steps, 2);
  EXPECT_LE(tilted.steps, 6) << "superlinear";
}

TEST_P(Optimum, OfALeaningBoxIsFilledUpToAPlaneThroughItsCentreOfMass) {
  if (voxels()) GTEST_SKIP() << "known for rays alone";
  const MassModel mass = shell({-0.05, 0, 0.7});
  const Base base{hull_of({{-0.2, -0.3}, {0.22, -0.3}, {0.22, 0.3}, {-0.2, 0.3}}), 0, 1.25};
  const double h2 = mass.contrast * BoxDomain::h * BoxDomain::h;
  // Centre of mass at x = p and height c: heights c + mu (x - p), mu from the balance about p.
  const auto at_height = [&](double p, double c) {
    double squares = 0, first = 0;
    for (const Vec2& at : rays()) {
      squares += (at[0] - p) * (at[0] - p);
      first += at[0] - p;
    }
    const double mu = (-(mass.fixed[SX] - p * mass.fixed[S1]) / h2 - (c - bottom) * first) / squares;
    return filled(mass, [&](const Vec2& at) { return c + mu * (at[0] - p); });
  };
  const auto lowest = [&](double p) {
    return root(bottom, 0.7, [&](double c) {
      const auto s = at_height(p, c);
      return c * s[S1] - s[SZ];
    });
  };
  ASSERT_NEAR(at_height(0.01, 0.4)[SX], 0.01 * at_height(0.01, 0.4)[S1], 1e-15);
  const Outcome centred = solve(Stand(base, std::nullopt), mass);
  EXPECT_NEAR(centred.objective, lowest(0.01), gap_);
  // A margin of 0.19 leaves x between -0.01 and 0.03: the shell leans to the left, so the left edge binds.
  const Outcome inside = solve(Stand(base, 0.19), mass);
  EXPECT_NEAR(inside.objective, lowest(-0.01), gap_);
  EXPECT_NEAR(inside.moments[SX] / inside.moments[S1], -0.01, 1e-5) << "the barrier keeps a distance";
}

TEST_P(Optimum, OfABalancedBoxLeavesOutTheFarEnd) {
  // Point above and below the middle: material is left out at the bottom, or at the top.
  const double m = 0.2, z0 = 0.55;
  for (const bool above : {false, true}) {
    const auto mirrored = [&](double z) { return above ? 1.25 - z : z; };
    const MassModel mass = shell({0, 0, mirrored(z0)});
    const double p = 0.5, a = mass.contrast * area;
    const Outcome outcome = solve(Balance({0, 0, mirrored(p)}, std::nullopt), mass);
    // m (z0 - p) + a ((T^2 - b^2) / 2 - p (T - b)) = 0.
    double fill = p + std::sqrt(p * p - 2 * (m / a * (z0 - p) - bottom * bottom / 2 + p * bottom)) - bottom;
    ASSERT_LT(fill, BoxDomain::height);
    if (voxels()) {
      double moment = m * (z0 - p);
      fill = 0;
      for (int k = 0; k < BoxDomain::layers; ++k) {
        const double arm = bottom + (k + 0.5) * BoxDomain::h - p;
        const double share = arm <= 0 ? 1 : std::clamp(-moment / (a * BoxDomain::h * arm), 0.0, 1.0);
        moment += share * a * BoxDomain::h * arm;
        fill += share * BoxDomain::h;
      }
    }
    EXPECT_NEAR(outcome.objective, -(m + a * fill), gap_) << (above ? "above" : "below");
    // The line along z through the middle is met by the whole box.
    const Outcome free = solve(Balance({0, 0, 0.5}, Vec3(0, 0, 1)), mass);
    EXPECT_NEAR(free.objective, -(m + a * BoxDomain::height), gap_);
  }
}

TEST_P(Optimum, OfTheTiltIsThatOfABisection) {
  const MassModel mass = shell({-0.06, 0.03, 0.8});
  const Base base{hull_of({{-0.2, -0.3}, {0.22, -0.25}, {0.1, 0.3}, {-0.15, 0.2}}), 0, 1.25};
  const double start = base.tangent(centre_of_mass(mass.total(BoxDomain::columns().interior)));
  ASSERT_GT(start, 0);
  const Outcome direct = solve(MaxTilt(base, start), mass);
  const double reached = -direct.objective;
  EXPECT_GT(reached, start + 0.05) << "nothing gained, nothing tested";
  EXPECT_LE(direct.steps, 6) << "superlinear";
  EXPECT_NEAR(base.tangent(centre_of_mass(direct.moments)), reached, 1e-14);

  const double gap = gap_;
  const auto out_of_reach = [&](double tau) {
    const MaxTilt at(base, tau);
    const Task task{at, *formulation_, mass, test_device()};
    const Outcome outcome = default_solver(GetParam().formulation).solve(task, options_of(GetParam()));
    return (at.constraints().matrix * outcome.moments).maxCoeff();
  };
  double low = start, high = 1;
  ASSERT_GT(out_of_reach(high), 0.01);
  for (int i = 0; i < 16; ++i) (out_of_reach((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  // 2^-16 of the first range; a margin's gap over the first moment of the height, at least that of the shell.
  EXPECT_NEAR(reached, low, 2e-5 + 2 * gap / mass.fixed[SZ]);
}

INSTANTIATE_TEST_SUITE_P(Ways, Optimum, testing::ValuesIn(ways()),
                         [](const auto& p) { return name_of(p.param); });

}  // namespace THIS_FILE
}  // namespace kreisel::core
