// top_test.cpp - SpinIt's tops and yo-yos: values by principal moments, derivatives, both forms, verdicts.
#include "problem/top.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "domain/test_bodies.hpp"
#include "problem/differences.hpp"
#include "problem/principal_angle.hpp"
#include "problem/yoyo.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double round_off = 256 * 0x1p-53;  // quotients of sums of a few dozen products
constexpr Lower all_lower[] = {Lower::mass, Lower::height, Lower::none};

/// A body on its axis whose lateral axes are turned.
Moments turned_box() {
  return 0.8 * transformed(box_moments(Vec3::Zero(), {1.4, 0.9, 0.5}),
                           Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix(), {0, 0, 0.7});
}

/// f has powers of Izz and s1 below, up to the fourth: a third of the smaller is room for their factors.
double below(const Moments& s) { return std::min(s[S1], s[SXX] + s[SYY]) / 3; }

TEST(Top, IsTheSumOfItsTermsByPrincipalMoments) {
  const Moments s = turned_box();
  // Of a box: m (b^2 + c^2) / 12, and so on; its height is 0.7, its mass 0.8 of its volume.
  const double m = 0.8 * 1.4 * 0.9 * 0.5, a = 0.9 * 0.9 + 0.5 * 0.5, b = 1.4 * 1.4 + 0.5 * 0.5,
               c = 1.4 * 1.4 + 0.9 * 0.9, ratio = (a * a + b * b) / (c * c);
  const double want[] = {2.5 * (0.7 * m) * (0.7 * m) + 3 * ratio, 2.5 * 0.7 * 0.7 + 3 * ratio, 3 * ratio};
  for (const Lower lower : all_lower) {
    const double value = Top({.gamma_c = 2.5, .gamma_i = 3, .lower = lower}).value(s);
    EXPECT_NEAR(value, want[static_cast<int>(lower)], round_off * value);
  }
  const Moments about_q = transformed(s, Eigen::Matrix3d::Identity(), {0, 0, -0.7});
  EXPECT_NEAR(Yoyo({.gamma_i = 3}).value(about_q), 3 * ratio, round_off * 3 * ratio);
}

TEST(Top, DerivativesMatchCentralDifferences) {
  Random random(51);
  for (const Lower lower : all_lower)
    for (int trial = 0; trial < 5; ++trial) {
      const Moments s = random_solid(random);
      expect_derivatives(Top({.gamma_c = 1.5, .gamma_i = 0.7, .lower = lower}), s, below(s));
    }
}

TEST(PrincipalAngle, StartsWhereTheLateralProductVanishesAndItsValueIsTheTraceForm) {
  Random random(52);
  for (int trial = 0; trial < 5; ++trial) {
    const Moments s = random_solid(random);
    const SpinWeights weights{.moment = 1.5, .gamma_i = 0.7};
    const PrincipalAngle angle(weights);
    const Eigen::VectorXd phi = angle.start(s);
    EXPECT_NEAR(angle.rows(s, phi)[0], 0, round_off);
    EXPECT_NEAR(angle.value(s, phi), weights.value(s), round_off * weights.value(s));
    // Elsewhere both differ by what is left beside the diagonal: tr(J^2) = Ia^2 + Ib^2 + 2 g^2.
    const Eigen::VectorXd other = phi.array() + 0.3;
    const double g = angle.rows(s, other)[0] / (s[SXX] + s[SYY]);
    EXPECT_GT(std::abs(g), 1e-3);
    EXPECT_NEAR(angle.value(s, other) + 0.7 * 2 * g * g, weights.value(s), round_off * weights.value(s));
  }
}

TEST(PrincipalAngle, DerivativesMatchCentralDifferences) {
  Random random(53);
  for (int trial = 0; trial < 5; ++trial) {
    const Moments s = random_solid(random);
    const PrincipalAngle angle({.height = 0.6, .moment = 1.5, .gamma_i = 0.7});
    const QuotientDifferences d{below(s)};
    const Eigen::VectorXd phi = angle.start(s).array() + uniform(random, -1, 1),
                          one = Eigen::VectorXd::Constant(1, 1);
    const Eigen::VectorXd gradient = angle.gradient(s, phi);
    const Eigen::MatrixXd hessian = angle.hessian(s, phi), jacobian = angle.jacobian(s, phi),
                          curvature = angle.curvature(s, phi, one);
    const double size = gradient.cwiseAbs().maxCoeff() + 1;
    EXPECT_LE((hessian - hessian.transpose()).cwiseAbs().maxCoeff(), round_off * size / below(s));
    for (int k = 0; k < 11; ++k) {
      Moments up = s, down = s;
      Eigen::VectorXd phi_up = phi, phi_down = phi;
      (k < 10 ? up[k] : phi_up[0]) += d.step();
      (k < 10 ? down[k] : phi_down[0]) -= d.step();
      const double width = 2 * d.step();
      EXPECT_NEAR(gradient[k], (angle.value(up, phi_up) - angle.value(down, phi_down)) / width,
                  d.tolerance(angle.value(s, phi) + 1));
      EXPECT_NEAR(jacobian(0, k), (angle.rows(up, phi_up) - angle.rows(down, phi_down))[0] / width,
                  d.tolerance(1));
      const Eigen::VectorXd column = (angle.gradient(up, phi_up) - angle.gradient(down, phi_down)) / width,
                            bend = (angle.jacobian(up, phi_up) - angle.jacobian(down, phi_down)).transpose() /
                                   width;
      EXPECT_LE((hessian.col(k) - column).cwiseAbs().maxCoeff(), d.tolerance(size)) << k;
      EXPECT_LE((curvature.col(k) - bend).cwiseAbs().maxCoeff(), d.tolerance(1)) << k;
    }
  }
}

TEST(TopVerdict, SaysHowMuchSlowerThanTheSolidItMaySpin) {
  constexpr double length_mm = 50;
  const Moments solid = box_moments({0, 0, 0.5}, {1.5, 1.5, 1}),
                flat = box_moments({0, 0, 0.125}, {2, 2, 0.25});
  const Verdict verdict = Top({}, solid).verify(flat, length_mm);
  ASSERT_TRUE(verdict.ok) << verdict.text;
  // omega^2 = g c / ((Izz - Ixx) L) by hand, per mass [SpinIt, eq. 1].
  const double of_solid = 0.5 / ((4.5 - 3.25) / 12), of_flat = 0.125 / ((8 - 4.0625) / 12);
  EXPECT_NEAR(verdict.values.at("omega_reduction"), std::sqrt(of_solid / of_flat), 1e-12);
  expect_text(verdict, "times slower than the solid's");
  const Verdict from_tower = Top({}, box_moments({0, 0, 1}, {0.5, 0.5, 2})).verify(flat, length_mm);
  EXPECT_TRUE(std::isnan(from_tower.values.at("omega_reduction")));
  expect_text(from_tower, "the solid at no speed");
  EXPECT_FALSE(Top({}).verify(flat, length_mm).values.contains("omega_reduction")) << "no solid was given";
}

TEST(YoyoVerdict, AsksForTheCentreOfMassAtTheAxlesCentre) {
  constexpr double length_mm = 50;
  const Verdict good = Yoyo({}).verify(box_moments({0, 0, 0.0009}, {2, 2, 0.25}), length_mm);
  EXPECT_TRUE(good.ok) << good.text;
  EXPECT_TRUE(std::isnan(good.values.at("omega_min_rpm")));
  const Verdict high = Yoyo({}).verify(box_moments({0, 0, 0.0011}, {2, 2, 0.25}), length_mm);
  EXPECT_FALSE(high.ok);
  expect_text(high, "centre of mass off the axle's centre by more than 1e-3 L");
}

TEST(MakeTop, RefusesWhatMakesNoSense) {
  const Body body = body_of(box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  expect_refused("top", {{"gamma_c", "-1"}}, body, "problem.gamma_c = -1");
  expect_refused("top", {{"gamma_i", "0"}}, body, "problem.gamma_i = 0");
  expect_refused("top", {{"lower", "l"}}, body, "problem.lower = l");
  expect_refused("top", {{"form", "phi"}}, body, "problem.form = phi");
  expect_refused("top", {{"gamma_c", "inf"}}, body, "problem.gamma_c = inf");
  expect_refused("yoyo", {{"gamma_i", "-2"}}, body_of(box_mesh({-1, -1, -1}, {1, 1, 1})),
                 "problem.gamma_i = -2");
  expect_refused("yoyo", {}, body_of(box_mesh({-0.5, -0.5, 0.1}, {0.5, 0.5, 1})), "axle's centre 0,0,0");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
