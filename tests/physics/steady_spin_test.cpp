// steady_spin_test.cpp - stability of steady spin: against closed forms, the equations' own Jacobian, and
// motions on both sides of what it says.
#include "physics/steady_spin.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/motion.hpp"
#include "physics/test_bodies.hpp"
#include "physics/units.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double infinity = std::numeric_limits<double>::infinity();

double largest_tilt(const RigidBody& top, double speed, double tilt, double turns) {
  const MotionOptions options{turns * 2 * std::numbers::pi / speed, 10, 1.2};
  return simulate(top, tilted_start(top, speed, tilt), options).largest_tilt;
}

/// Largest real part of the eigenvalues of the equations of motion at a state, by differences.
double growth_by_differences(const RigidBody& top, const BodyState& state) {
  Eigen::Matrix<double, 6, 6> jacobian;
  const double h = 1e-5;
  for (int k = 0; k < 6; ++k) {
    const auto moved = [&](double by) {
      BodyState s = state;
      (k < 3 ? s.up[k] : s.momentum[k - 3]) += by;
      const BodyState rate = derivative(top, s);
      return (Eigen::Matrix<double, 6, 1>() << rate.up, rate.momentum).finished();
    };
    jacobian.col(k) = (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
  }
  return jacobian.eigenvalues().real().maxCoeff();
}

TEST(StableSpeeds, OfASymmetricTopAreThoseOfTheSleepingTop) {
  // c^2 w^2 > 4 a M g l, moments about the centre of mass when gliding, about the tip when held.
  for (const Vec3& principal : {Vec3(0.08, 0.08, 0.12), Vec3(0.12, 0.12, 0.05), Vec3(0.06, 0.06, 0.119)}) {
    const Moments s = moments_of(0.4, 0.6, principal);
    for (const Contact contact : {Contact::gliding, Contact::held}) {
      const double a = principal[0] + (contact == Contact::held ? 0.4 * 0.6 * 0.6 : 0);
      const double threshold = 2 * std::sqrt(a * 0.4 * 0.6) / principal[2];
      const RigidBody top = make_rigid_body(s, contact);
      const auto ranges = stable_speeds(top);
      ASSERT_EQ(ranges.size(), 1u);
      EXPECT_NEAR(ranges[0].low, threshold, 1e-7 * threshold);
      EXPECT_EQ(ranges[0].high, infinity);
      EXPECT_EQ(stable_above(ranges), ranges[0].low);
      EXPECT_FALSE(steady_spin(top, 0.999 * threshold, 1)->stable());
      EXPECT_TRUE(steady_spin(top, 1.001 * threshold, 1)->stable());
    }
  }
  // Of a mesh, equal moments are equal to round-off: no gap that nobody could see.
  const auto nearly =
      stable_speeds(make_rigid_body(moments_of(0.4, 0.6, {0.08, 0.08 + 1e-12, 0.12}), Contact::gliding));
  EXPECT_EQ(nearly.size(), 1u);
  // A thin plate, c = 2 a: eq. 1 itself.
  const auto plate = stable_speeds(make_rigid_body(moments_of(1, 0.5, {0.1, 0.1, 0.2}), Contact::gliding));
  ASSERT_EQ(plate.size(), 1u);
  EXPECT_NEAR(plate[0].low, std::sqrt(0.5 / 0.1), 1e-12);
}

TEST(StableSpeeds, AreWhereMotionsStayNearTheAxis) {
  const Moments s = moments_of(0.4, 0.6, {0.08, 0.08, 0.12});
  for (const Contact contact : {Contact::gliding, Contact::held}) {
    const RigidBody top = make_rigid_body(s, contact);
    const double threshold = *stable_above(stable_speeds(top));
    EXPECT_LT(largest_tilt(top, 1.02 * threshold, 1e-3, 60), 0.02);
    EXPECT_GT(largest_tilt(top, 0.98 * threshold, 1e-3, 60), 0.2);
  }
}

TEST(StableSpeeds, OfUnequalMomentsMayHaveAGap) {
  // Gyroscopic forces hold this one at low speeds; between p / (c - a) and p / (c - b) nothing does; above is
  // eq. 1.
  const double a = 0.09, b = 0.1, c = 0.12, p = 0.4 * 0.3;
  const RigidBody top = make_rigid_body(moments_of(0.4, 0.3, {a, b, c}), Contact::gliding);
  const auto ranges = stable_speeds(top);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_NEAR(ranges[0].high, std::sqrt(p / (c - a)), 1e-12);
  EXPECT_NEAR(ranges[1].low, std::sqrt(p / (c - b)), 1e-12);
  EXPECT_EQ(ranges[1].high, infinity);
  const double low = ranges[0].low, gap = ranges[0].high, above = ranges[1].low;
  EXPECT_GT(largest_tilt(top, 0.95 * low, 1e-3, 60), 0.2);
  EXPECT_LT(largest_tilt(top, (low + gap) / 2, 1e-3, 60), 0.02);
  EXPECT_GT(largest_tilt(top, (gap + above) / 2, 1e-3, 60), 0.2);
  EXPECT_LT(largest_tilt(top, 1.1 * above, 1e-3, 60), 0.02);
}

TEST(StableSpeeds, AgreeWithTheSpectrumAtEverySpeedAndWithEquationOneWhenGliding) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> height(0.1, 1.2);
  int held_unstable_above_eq1 = 0, windows = 0;
  for (int body = 0; body < 300; ++body) {
    const Vec3 principal = random_principal(random);
    const Moments s = moments_of(0.5, height(random), principal);
    const double next = std::max(principal[0], principal[1]);
    const double eq1 = principal[2] > next ? std::sqrt(s[SZ] / (principal[2] - next)) : infinity;
    for (const Contact contact : {Contact::gliding, Contact::held}) {
      const RigidBody top = make_rigid_body(s, contact);
      const auto ranges = stable_speeds(top);
      windows += std::ranges::any_of(ranges, [](const SpeedRange& r) { return std::isfinite(r.high); });
      for (double speed = 0.1; speed < 1000; speed *= 1.05) {
        if (std::ranges::any_of(ranges, [&](const SpeedRange& r) {
              return std::abs(speed - r.low) < 1e-6 * speed || std::abs(speed - r.high) < 1e-6 * speed;
            }))
          continue;
        const bool inside =
            std::ranges::any_of(ranges, [&](const SpeedRange& r) { return speed > r.low && speed < r.high; });
        const auto steady = steady_spin(top, speed, 1);
        ASSERT_TRUE(steady);
        ASSERT_EQ(steady->stable(), inside) << speed << " of body " << body;
        if (speed > eq1 && !inside) {
          EXPECT_EQ(contact, Contact::held) << "eq. 1 is sufficient for a gliding tip";
          ++held_unstable_above_eq1;
        }
      }
    }
  }
  EXPECT_GT(held_unstable_above_eq1, 0) << "eq. 1 is not sufficient for a tip held in place";
  EXPECT_GT(windows, 0);
}

TEST(SteadySpin, OfAnyBodyHasTheGrowthOfTheEquationsOfMotion) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> small(-0.01, 0.01), size(0.05, 0.12);
  int growing = 0, steady_ones = 0;
  for (int body = 0; body < 40; ++body) {
    Eigen::Matrix3d inertia = random_principal(random).asDiagonal();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < r; ++c) inertia(r, c) = inertia(c, r) = small(random);
    const Moments s = moments_of(0.5, Vec3(small(random), small(random), 0.5), inertia);
    for (const Contact contact : {Contact::gliding, Contact::held}) {
      const RigidBody top = make_rigid_body(s, contact);
      for (double speed = 1; speed < 60; speed *= 1.6) {
        const auto steady = steady_spin(top, speed, 0.5);
        if (!steady) continue;
        ++steady_ones;
        BodyState state;
        state.up = steady->up;
        state.momentum = speed * (top.inertia * steady->up);  // (p x u) . u = 0: it neither rises nor falls
        const BodyState rate = derivative(top, state);
        ASSERT_LT(rate.up.norm() + rate.momentum.norm(), 1e-9 * speed * speed);
        // Two eigenvalues are zero, and by differences zero to the root of round-off.
        const double want = growth_by_differences(top, state);
        EXPECT_NEAR(steady->growth, want, 1e-4 * speed);
        growing += steady->growth > 0.01 * speed;
      }
    }
  }
  EXPECT_GT(steady_ones, 300);
  EXPECT_GT(growing, 50);
}

TEST(SteadySpin, GrowsAsTheMotionDoes) {
  const RigidBody top = make_rigid_body(moments_of(0.4, 0.6, {0.08, 0.08, 0.12}), Contact::gliding);
  const double speed = 0.8 * *stable_above(stable_speeds(top));
  const double growth = steady_spin(top, speed, 1)->growth;
  ASSERT_GT(growth, 0);
  const Motion motion = simulate(top, tilted_start(top, speed, 1e-7), {8 / growth, 80});
  EXPECT_NEAR(std::log(motion.tilts[70] / motion.tilts[35]), 3.5, 0.05);
}

TEST(SteadySpin, IsTiltedByWhatTheBodyIsUnbalanced) {
  // To first order (w^2 Ixz - p_x) / ((c - a) w^2 - p_z) about each axis.
  Eigen::Matrix3d inertia = Vec3(0.08, 0.09, 0.12).asDiagonal();
  inertia(0, 2) = inertia(2, 0) = 1e-5;
  const RigidBody top = make_rigid_body(moments_of(0.4, Vec3(0, 2e-5, 0.6), inertia), Contact::gliding);
  const double square = 15 * 15, x = (square * top.inertia(0, 2) - top.lever[0]) /
                                     ((top.inertia(2, 2) - top.inertia(0, 0)) * square - top.lever[2]);
  const double y = (square * top.inertia(1, 2) - top.lever[1]) /
                   ((top.inertia(2, 2) - top.inertia(1, 1)) * square - top.lever[2]);
  const auto steady = steady_spin(top, 15, 0.1);
  ASSERT_TRUE(steady);
  EXPECT_NEAR(steady->up[0], x, 1e-6 * std::abs(x) + 1e-9);
  EXPECT_NEAR(steady->up[1], y, 1e-6 * std::abs(y) + 1e-9);
  // None near the axis of a body that lies askew.
  inertia(0, 2) = inertia(2, 0) = 0.03;
  const RigidBody askew = make_rigid_body(moments_of(0.4, Vec3(0, 0, 0.6), inertia), Contact::gliding);
  EXPECT_FALSE(steady_spin(askew, 15, radians(10)));
}

TEST(Units, OneIsTheRootOfLengthOverGravity) {
  EXPECT_NEAR(seconds_per_unit(9806.65), 1, 1e-15);
  EXPECT_NEAR(rpm_per_unit(9806.65), 60 / (2 * std::numbers::pi), 1e-12);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
