// certificate_test.cpp - bounds against optima found by hand, against whatever is attained, on random bodies.
#include "solve/certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "body/mesh_moments.hpp"
#include "formulation/quadric.hpp"
#include "problem/float.hpp"
#include "problem/spin.hpp"
#include "problem/stand.hpp"
#include "solve/certified_cases.hpp"
#include "solve/certify_spin.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(SafeSupport, IsTheReferenceUpToItsMargin) {
  const Case on = top();
  const Rays rays = rays_of(on.domain);
  const SafeSupport support(rays, on.mass);
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    Moments q;
    for (double& c : q) c = uniform(random, -1, 1);
    const auto value = support.at(q);
    const double want = q.dot(on.mass.total(reference::quadric_moments(rays, q).value));
    // The reference adds in one chain: some thousand additions.
    EXPECT_NEAR(value.h, want, value.margin + 2e3 * 0x1p-53 * q.cwiseAbs().sum());
    EXPECT_GT(value.margin, 0);
    EXPECT_LT(value.margin, 1e-12 * q.cwiseAbs().sum());
    // The least of all: any other filling has as much or more.
    Moments other;
    for (double& c : other) c = uniform(random, -1, 1);
    EXPECT_LE(value.h - value.margin, q.dot(support.at(other).s));
  }
}

TEST(SafeSupport, FindsTheLargestRatioFromAnywhere) {
  const Case on = top();
  const SafeSupport support(rays_of(on.domain), on.mass);
  const Moments z = Moments::Unit(SZ), one = Moments::Unit(S1);
  const double lowest = support.largest_ratio(z, one, 0.5).value();
  EXPECT_TRUE(support.certainly_positive(z - lowest * one));
  EXPECT_LT(support.at(z - (lowest + 1e-11) * one).h, 0);
  for (const double start : {-10.0, 0.0, 0.7, 10.0})
    EXPECT_NEAR(support.largest_ratio(z, one, start).value(), lowest, 1e-11) << start;
  // Without a shell there may be nothing: h is 0 at best, and nothing is certain.
  const SafeSupport bare(rays_of(on.domain), MassModel{});
  EXPECT_FALSE(bare.largest_ratio(z, one, 0.5));
}

TEST(Certificate, OfAFloatingBoxIsItsOptimum) {
  const MassModel mass{0.2 * box_moments({0, 0, 0.7}, {1, 1, 1}), 0.75};
  const double bottom = BoxDomain::base, fill = 0.65;
  const double total = mass.fixed[S1] + mass.contrast * BoxDomain::area * fill;
  const Float problem({{0.5, 1, Vec3(0, 0, 0.3), 1, 1}, total, 1, 1});
  const Certificate c = certify(problem, rays_of(BoxDomain::columns()), mass, test_device(), {});
  const double want = (mass.fixed[SZ] + mass.contrast * BoxDomain::area * fill * (bottom + fill / 2)) / total;
  EXPECT_EQ(c.kind, Certificate::Kind::linear);
  EXPECT_TRUE(c.reached);
  EXPECT_LE(c.bound, want + 1e-15);
  EXPECT_NEAR(c.bound, want, 1e-11);  // twice the margin, of a sum of terms near 1
}

TEST(Certificate, OfAStandingBoxIsItsOptimum) {
  const MassModel mass{0.2 * box_moments({0, 0, 0.7}, {1, 1, 1}), 0.75};
  const Base base{hull_of({{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}}), 0, 1.25};
  const double a = mass.contrast * BoxDomain::area, m = mass.fixed[S1], bottom = BoxDomain::base;
  const double p = m / a - bottom;
  const double want = -p + std::sqrt(p * p - bottom * bottom + 2 * mass.fixed[SZ] / a);
  for (const auto& problem : {Stand(base, std::nullopt), Stand(base, 0.05)}) {
    const Certificate c = certify(problem, rays_of(BoxDomain::columns()), mass, test_device(), {});
    EXPECT_EQ(c.kind, Certificate::Kind::ratio);
    EXPECT_LE(c.bound, want + 1e-15);
    EXPECT_NEAR(c.bound, want, 1e-11);
  }
  const Certificate tilt =
      certify(MaxTilt(base, 0.3 / 0.7), rays_of(BoxDomain::columns()), mass, test_device(), {});
  EXPECT_LE(tilt.bound, -0.3 / want + 1e-15);
  EXPECT_NEAR(tilt.bound, -0.3 / want, 1e-6);  // where its steps end
}

TEST(Certificate, OfWhatCannotBeMetSeparates) {
  const Case on = top(0.4);  // too far off its axis
  const Certificate c = on.certified(Spin({}));
  ASSERT_EQ(c.kind, Certificate::Kind::infeasible);
  EXPECT_GT(c.separation, 0);
  EXPECT_TRUE(std::isinf(c.bound));
  // The rows are s = 0, so q . s > 0 of every filling.
  EXPECT_GT(c.q.dot(on.body.solid), 0);
  EXPECT_GT(c.q.dot(on.mass.fixed), 0);
}

TEST(Certificate, OfWhatCannotStandBoundsItsTilt) {
  const MassModel mass{0.5 * box_moments({1, 0, 0.7}, {1, 1, 1}), 0.75};
  const Base base{hull_of({{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}}), 0, 1.25};
  const Certificate c = certify(MaxTilt(base, 0), rays_of(BoxDomain::columns()), mass, test_device(), {});
  EXPECT_EQ(c.kind, Certificate::Kind::ratio);
  EXPECT_GT(c.bound, 0);
  EXPECT_LE(c.bound, c.best);
  EXPECT_NE(c.message.find("above 0"), std::string::npos) << c.message;
}

TEST(Certificate, OnASingleDeviceIsAsRigorous) {
  const Case on = top();
  const Spin problem({1, 1});
  const Certificate fine = on.certified(problem);
  const Certificate c = certify(problem, rays_of(on.domain), on.mass, single_device(), {});
  EXPECT_TRUE(c.reached) << c.message;
  EXPECT_LE(c.bound, fine.best);
  EXPECT_NEAR(c.bound, fine.bound, 2e-3 * fine.best);
}

TEST(Certificate, BoundsWhateverIsAttained) {
  Random random(11);
  const Case on = top();
  for (const double lambda : {0.0, 1.0}) {
    const Spin problem({lambda, 1});
    const Certificate c = on.certified(problem);
    EXPECT_TRUE(c.reached) << c.message;
    EXPECT_LE(c.bound, c.best);
    const std::vector<Moments> all = attainable(on, problem, random, 40);
    ASSERT_GT(all.size(), 40u);
    for (const Moments& s : all) EXPECT_LE(c.bound, problem.value(s));
    for (const std::string way : {"voxel", "rayrep"}) {
      const auto formulation = make_formulation(way, on.domain, {}, {}, test_device());
      const Outcome outcome =
          solve(find_solver("ipopt", way), {problem, *formulation, on.mass, test_device()}, {});
      // What Ipopt's violation may win: multipliers of order one.
      EXPECT_LE(c.bound, outcome.objective + 10 * outcome.violation) << way;
      EXPECT_LE((outcome.objective - c.best) / c.best, 0.01) << way;
    }
  }
}

/// The bounds of boxes lead to the optimum even where the solver has missed it.
TEST(Certificate, FindsABetterOneThanItWasGiven) {
  Random random(13);
  const Case on = top();
  const Spin problem({0.5, 1});
  const Certificate right = on.certified(problem);
  const auto quadric = make_quadric(on.domain, {}, {}, test_device());
  const Task task{problem, *quadric, on.mass, test_device()};
  const SafeSupport support(rays_of(on.domain), on.mass);
  Outcome poor;
  poor.moments = attainable(on, problem, random, 5).front();
  ASSERT_GT(problem.value(poor.moments), right.best + 0.01);
  Certificate c;
  c.best = problem.value(poor.moments);
  certify_spin(c, problem, task, support, poor, {}, [] { return 0.0; });
  EXPECT_NEAR(c.best, right.best, 1e-12);
  EXPECT_LE(c.best - c.bound, gap * c.best);
  const Moments reached = on.mass.total(quadric->moments(c.best_x));
  EXPECT_NEAR(problem.value(reached), right.best, 1e-12);
}

/// Boxes grow like the logarithm of the gap. [docs/quadric.md, s. 4]
TEST(Certificate, TakesFewBoxesForASmallGap) {
  const Case on = top();
  for (const double lambda : {0.0, 1.0}) {
    const Certificate rough = on.certified(Spin({lambda, 1}), {.gap = 1e-3});
    const Certificate fine = on.certified(Spin({lambda, 1}), {.gap = 1e-7});
    EXPECT_TRUE(fine.reached) << fine.message;
    EXPECT_LE(fine.best - fine.bound, 1e-7 * fine.best);
    // Four decades: some six halvings each of the boxes about the minimum, two or three wide.
    EXPECT_LE(fine.boxes.size(), rough.boxes.size() + 80);
    RecordProperty("boxes", static_cast<int>(fine.boxes.size()));
  }
}

/// Bounds do not depend on where their multipliers come from.
TEST(Certificate, OfABoxHoldsWhateverTheMultipliers) {
  Random random(12);
  expect_bounds_whatever_the_multipliers(Spin({0.5, 1.5}), random, 200, [&](const Moments& s) {
    const double c = centre_of_mass(s)[2];
    return SpinRegion{c - uniform(random, 0, 0.05), c + uniform(random, 0, 0.05)};
  });
}

TEST(Certificate, CoversEveryHeight) {
  const Certificate c = top().certified(Spin({1, 1}));
  ASSERT_GE(c.boxes.size(), 3u);
  EXPECT_TRUE(std::isinf(c.boxes.front().low) && std::isinf(c.boxes.back().high));
  EXPECT_TRUE(c.boxes.front().empty && c.boxes.back().empty);
  for (std::size_t i = 1; i < c.boxes.size(); ++i) EXPECT_EQ(c.boxes[i].low, c.boxes[i - 1].high);
}

TEST(Certificate, StopsAtItsLimitsAndSaysSo) {
  const Case on = top();
  const Certificate cut = on.certified(Spin({1, 1}), {.gap = 1e-9, .most_boxes = 20});
  EXPECT_FALSE(cut.reached);
  EXPECT_NE(cut.message.find("20 boxes"), std::string::npos) << cut.message;
  EXPECT_LT(cut.bound, cut.best);
  const Certificate late = on.certified(Spin({1, 1}), {.gap = 1e-9, .seconds = 0});
  EXPECT_NE(late.message.find("0 seconds"), std::string::npos) << late.message;
  EXPECT_TRUE(std::isfinite(late.bound));
}

TEST(Certificate, OfRandomBodiesIsWithinItsGapOrSeparates) {
  Random random(2024);
  const int feasible = expect_certified_or_separated(random, [&](int i) {
    return std::make_unique<Spin>(SpinOptions{i % 2 ? 0.0 : uniform(random, 0, 1), uniform(random, 0.5, 2)});
  });
  EXPECT_GE(feasible, 10);
  EXPECT_LE(feasible, 37);
}

TEST(MomentSolver, ReachesTheCertifiedOptimumFromRandomStarts) {
  for (const char* model : {"ellipsoid", "bird", "heart", "teapot"}) {
    BodySpec spec;
    spec.model = model;
    const Case on(make_body(spec, test_device()), 24);
    for (const double lambda : {0.0, 1.0}) {
      const Spin problem({lambda, 1});
      const Certificate c = on.certified(problem, {.gap = gap});
      if (c.kind == Certificate::Kind::infeasible) continue;
      EXPECT_TRUE(c.reached) << model << ": " << c.message;
      const auto quadric = make_quadric(on.domain, {}, {}, test_device());
      for (int seed = 1; seed <= 5; ++seed) {
        SolverOptions options;
        options.own = solvers().find("moment").read({{"seed", std::to_string(seed)}});
        const Outcome outcome =
            solve(find_solver("moment", "quadric"), {problem, *quadric, on.mass, test_device()}, options);
        EXPECT_EQ(to_string(outcome.termination), "optimal")
            << model << ' ' << seed << ' ' << outcome.message;
        EXPECT_LE(outcome.objective, c.bound + 2 * gap * std::abs(c.best)) << model << ' ' << seed;
      }
    }
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
