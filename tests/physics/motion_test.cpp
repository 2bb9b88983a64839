// motion_test.cpp - the integrator against closed forms: Lagrange's top, the gliding top, Euler's free body.
#include "physics/motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "physics/gauss_step.hpp"
#include "physics/jacobi.hpp"
#include "physics/test_bodies.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double pi = std::numbers::pi;
// Steps of 0.15 radians of the fastest rate leave 1e-9 or so over some tens of turns.
constexpr double method = 1e-8;

const Moments symmetric = moments_of(0.4, 0.6, {0.08, 0.08, 0.12});
const Moments uneven = moments_of(
    0.4, Vec3(0.003, -0.002, 0.6),
    (Eigen::Matrix3d() << 0.09, 0.004, 0.001, 0.004, 0.07, -0.002, 0.001, -0.002, 0.13).finished());

TEST(GaussStep, IsOfOrderSixAndKeepsQuadraticInvariants) {
  // y'' = -y + y^3 / 6 has no quadratic invariant, a rotation has one.
  const auto error = [](int steps) {
    const auto field = [](const Eigen::Vector2d& y) {
      return Eigen::Vector2d(y[1], -y[0] + std::pow(y[0], 3) / 6);
    };
    Eigen::Vector2d y(1, 0);
    Eigen::Matrix<double, 2, 3> slopes = field(y).replicate<1, 3>();
    for (int i = 0; i < steps; ++i) EXPECT_TRUE(gauss_step<2>(field, y, 6.0 / steps, slopes));
    return y;
  };
  const Eigen::Vector2d exact = error(400);
  const double order = std::log2((error(10) - exact).norm() / (error(20) - exact).norm());
  EXPECT_NEAR(order, 6, 0.3);

  const auto turn = [](const Eigen::Vector2d& y) { return Eigen::Vector2d(-y[1], y[0]); };
  Eigen::Vector2d y(1, 0);
  Eigen::Matrix<double, 2, 3> slopes = turn(y).replicate<1, 3>();
  for (int i = 0; i < 10000; ++i) ASSERT_TRUE(gauss_step<2>(turn, y, 0.3, slopes));
  EXPECT_NEAR(y.norm(), 1, 1e-13);
  // Without contraction there is no step.
  EXPECT_FALSE(gauss_step<2>(turn, y, 30, slopes));
}

TEST(RigidBody, GlidingObeysNewtonAndEuler) {
  const RigidBody top = make_rigid_body(uneven, Contact::gliding);
  BodyState state = tilted_start(top, 7, 0.4);
  state.momentum += Vec3(0.1, -0.2, 0.05);
  const double mass = uneven[S1];
  const Vec3 c = top.lever / mass, u = state.up, w = angular_velocity(top, u, state.momentum);
  // Unknown: w' and the force N. Torque about the centre of mass from N u at -c; M z'' = N - M, z = c . u.
  const Vec3 a = c.cross(u);
  Eigen::Matrix4d system;
  system << top.inertia, a, -mass * a.transpose(), 1;
  Eigen::Vector4d right;
  right << (top.inertia * w).cross(w), mass + mass * w.dot(c.cross(u.cross(w)));
  const Eigen::Vector4d answer = system.inverse() * right;
  EXPECT_NEAR(ground_force(top, state), answer[3] / mass, 1e-12);

  const BodyState rate = derivative(top, state);
  const double h = 1e-5;
  const Vec3 ahead = angular_velocity(top, u + h * rate.up, state.momentum + h * rate.momentum);
  const Vec3 behind = angular_velocity(top, u - h * rate.up, state.momentum - h * rate.momentum);
  EXPECT_LT(((ahead - behind) / (2 * h) - answer.head<3>()).norm(), 1e-7 * answer.norm());
}

/// Azimuth that body z has gone round by, in space.
double turned(const Motion& motion) {
  double sum = 0;
  Vec3 before;
  for (std::size_t i = 0; i < motion.states.size(); ++i) {
    const Vec3 z = Eigen::Quaterniond(motion.states[i].attitude) * Vec3::UnitZ();
    if (i > 0) sum += std::atan2(before[0] * z[1] - before[1] * z[0], before[0] * z[0] + before[1] * z[1]);
    before = z;
  }
  return sum;
}

TEST(Motion, HeldTopNutatesAndPrecessesAsLagrangesClosedForm) {
  const RigidBody top = make_rigid_body(symmetric, Contact::held);
  const double a = top.inertia(0, 0), c = top.inertia(2, 2), p = top.lever[2], spin = 9, tilt = 0.5;
  // From rest of the axis at v2 = cos(tilt): v'^2 = beta (v - v1)(v - v2)(v - v3), v = cos of the tilt.
  const double beta = 2 * p / a, b = c * spin / a, v2 = std::cos(tilt);
  const double root = std::sqrt(std::pow(b, 4) - 4 * beta * (b * b * v2 - beta));
  const double v1 = (b * b - root) / (2 * beta), v3 = (b * b + root) / (2 * beta);
  const double k = std::sqrt((v2 - v1) / (v3 - v1)), rate = std::sqrt(beta * (v3 - v1)) / 2;
  const double quarter = std::comp_ellint_1(k), period = 2 * quarter / rate;
  const auto height = [&](double t) {
    const double sn = jacobi(quarter + rate * t, k).sn;
    return v1 + (v2 - v1) * sn * sn;
  };

  constexpr int samples = 400, periods = 5;
  const Motion motion = simulate(top, tilted_start(top, spin, tilt), {periods * period, samples});
  for (int i = 0; i <= samples; ++i)
    ASSERT_NEAR(std::cos(motion.tilts[i]), height(motion.times[i]), method) << "at " << motion.times[i];
  EXPECT_NEAR(motion.tilts.back(), tilt, 1e-6);

  double precession = 0;  // the trapezoidal rule is as good as exact for a smooth periodic integrand
  for (int i = 0; i < samples; ++i) {
    const double v = height(period * i / samples);
    precession += b * (v2 - v) / (1 - v * v) * period / samples;
  }
  EXPECT_NEAR(turned(motion), periods * precession, 1e-6);
}

TEST(Motion, HeldTopPrecessesSteadilyAtBothRates) {
  const RigidBody top = make_rigid_body(symmetric, Contact::held);
  const double a = top.inertia(0, 0), c = top.inertia(2, 2), p = top.lever[2], spin = 12, tilt = 0.7;
  // a cos(tilt) n^2 - c spin n + p = 0: slow and fast precession, spin = w . body z.
  for (const int sign : {-1, 1}) {
    const double qa = a * std::cos(tilt), root = std::sqrt(c * c * spin * spin - 4 * qa * p);
    const double precession = (c * spin + sign * root) / (2 * qa);
    BodyState start = tilted_start(top, spin, tilt);
    const Vec3 across = (start.up - start.up[2] * Vec3::UnitZ());
    start.momentum += a * precession * across;
    const double turns = 3;
    const Motion motion = simulate(top, start, {turns * 2 * pi / precession, 100});
    EXPECT_NEAR(motion.largest_tilt, tilt, method);
    EXPECT_NEAR(motion.tilts.back(), tilt, method);
    EXPECT_NEAR(turned(motion), turns * 2 * pi, 1e-6);
  }
}

TEST(Motion, GlidingTopNutatesWithThePeriodOfItsEffectivePotential) {
  const RigidBody top = make_rigid_body(symmetric, Contact::gliding);
  const double a = top.inertia(0, 0), c = top.inertia(2, 2), p = top.lever[2], spin = 3, tilt = 0.5;
  const double extra = top.per_mass * p * p;  // M l^2
  // theta'^2 (a + M l^2 sin^2 theta) / 2 = p (v2 - v) - (c spin)^2 (v2 - v)^2 / (2 a (1 - v^2)), v = cos
  // theta.
  const double v2 = std::cos(tilt), b = c * c * spin * spin / (2 * a);
  // Zero of p (1 - v^2) - b (v2 - v).
  const double v1 = (b - std::sqrt(b * b - 4 * p * (b * v2 - p))) / (2 * p);
  const double v3 = (b + std::sqrt(b * b - 4 * p * (b * v2 - p))) / (2 * p);
  // v'^2 = 2 p (v - v1)(v2 - v)(v3 - v) / (a + M l^2 (1 - v^2)); v = middle + half cos: a smooth integrand.
  constexpr int n = 200;
  double period = 0;
  for (int i = 0; i < n; ++i) {
    const double v = (v1 + v2) / 2 + (v2 - v1) / 2 * std::cos(pi * (i + 0.5) / n);
    period += 2 * pi / n * std::sqrt((a + extra * (1 - v * v)) / (2 * p * (v3 - v)));
  }
  const Motion motion = simulate(top, tilted_start(top, spin, tilt), {4 * period, 8});
  for (int i = 0; i <= 8; ++i)
    EXPECT_NEAR(std::cos(motion.tilts[i]), i % 2 ? v1 : v2, method) << i << " halves of a period";
  EXPECT_GT(motion.largest_tilt, tilt + 0.1);
}

TEST(Motion, FreeBodyFollowsEulersSolution) {
  const Vec3 i(0.07, 0.1, 0.13);
  const RigidBody body = make_rigid_body(moments_of(1, 0, i), Contact::free);
  const Vec3 w0(2, 0, 3);
  BodyState start;
  start.momentum = i.cwiseProduct(w0);
  const double l2 = start.momentum.squaredNorm(), e2 = w0.dot(start.momentum);
  ASSERT_GT(l2, e2 * i[1]);  // round the largest axis [Landau, Lifshitz, Mechanics, s. 37]
  const double rate = std::sqrt((i[2] - i[1]) * (l2 - e2 * i[0]) / i.prod());
  const double k = std::sqrt((i[1] - i[0]) * (e2 * i[2] - l2) / ((i[2] - i[1]) * (l2 - e2 * i[0])));
  const Motion motion = simulate(body, start, {20 * std::comp_ellint_1(k) / rate, 200});
  const double across = std::sqrt((e2 * i[2] - l2) / (i[1] * (i[2] - i[1])));
  for (std::size_t n = 0; n < motion.times.size(); ++n) {
    const Jacobi j = jacobi(rate * motion.times[n], k);
    const Vec3 want(w0[0] * j.cn, across * j.sn, w0[2] * j.dn);
    ASSERT_LT((motion.states[n].momentum.cwiseQuotient(i) - want).norm(), method) << motion.times[n];
  }
}

TEST(Motion, FreeBodyFlipsAboutItsMiddleAxisAloneAndInTheClosedFormsTime) {
  const double spin = 3, tilt = 0.01;
  const auto flight = [&](const Vec3& principal, double duration) {
    const RigidBody body = make_rigid_body(moments_of(1, 0, principal), Contact::free);
    return simulate(body, free_start(body, spin, tilt), {duration, 400});
  };
  EXPECT_LT(flight({0.07, 0.1, 0.13}, 200).largest_tilt, 3 * tilt);
  EXPECT_LT(flight({0.13, 0.1, 0.07}, 200).largest_tilt, 3 * tilt);

  // About the middle: start between the other two axes; half a turn of the polhode later it is over.
  const Vec3 i(0.07, 0.13, 0.1);
  const RigidBody body = make_rigid_body(moments_of(1, 0, i), Contact::free);
  const BodyState start = free_start(body, spin, tilt);
  const double l2 = start.momentum.squaredNorm(), e2 = 2 * energy(body, start);
  const double least = 0.07, middle = 0.1, most = 0.13;
  const double one = (most - middle) * (l2 - e2 * least), other = (middle - least) * (e2 * most - l2);
  const double rate = std::sqrt(std::max(one, other) / i.prod());
  const double k = std::sqrt(std::min(one, other) / std::max(one, other));
  const double quarter = std::comp_ellint_1(k) / rate;
  const Motion motion = flight(i, 4 * quarter);
  EXPECT_NEAR(motion.tilts[200], pi - tilt, 1e-6) << "two quarters of the period";
  EXPECT_NEAR(motion.tilts[400], tilt, 1e-6) << "the whole of it";
}

TEST(Motion, KeepsEnergyAndMomentumOverHundredsOfTurns) {
  constexpr unsigned turns = 200;
  for (const Contact contact : {Contact::gliding, Contact::held}) {
    const RigidBody top = make_rigid_body(uneven, contact);
    const Motion motion = simulate(top, tilted_start(top, 20, 0.2), {turns * 2 * pi / 20, 100});
    ASSERT_FALSE(motion.fell_at);
    EXPECT_LT(motion.energy_drift, contact == Contact::held ? 1e-12 : 1e-9);
    EXPECT_LT(motion.momentum_drift, 1e-12);
    EXPECT_LT(motion.attitude_drift, 1e-5);
    EXPECT_GT(motion.steps, turns * 40u);
    const Motion again = simulate(top, tilted_start(top, 20, 0.2), {turns * 2 * pi / 20, 100});
    EXPECT_EQ(again.tilts, motion.tilts) << "the same bit for bit";
  }
}

TEST(Motion, EndsWhereTheTopHasFallen) {
  const RigidBody top = make_rigid_body(symmetric, Contact::gliding);
  const Motion motion = simulate(top, tilted_start(top, 0.1, 0.01), {100, 500, 1.0});
  ASSERT_TRUE(motion.fell_at);
  EXPECT_LT(*motion.fell_at, 10);
  EXPECT_EQ(motion.times.back(), *motion.fell_at);
  EXPECT_GE(motion.largest_tilt, 1);
  EXPECT_LT(motion.largest_tilt, 1.1);
}

TEST(Motion, RefusesWhatCannotMove) {
  const RigidBody top = make_rigid_body(symmetric, Contact::held);
  expect_refusal([&] { (void)simulate(top, tilted_start(top, 1, 0.1), {-1, 10}); }, "simulation", {});
  expect_refusal([&] { (void)simulate(top, tilted_start(top, 1, 0.1), {1, 0}); }, "simulation", {});
  expect_refusal(
      [&] {
        (void)simulate(top, tilted_start(top, NAN, 0.1), {1, 10});
      },
      "simulation", {"finite"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
