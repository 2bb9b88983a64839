#include "problem/spin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "body/test_meshes.hpp"
#include "error.hpp"
#include "problem/differences.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Eigen::Matrix3d about_x(double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitX()).toRotationMatrix();
}

/// The objective is a quotient of polynomials in s that varies over `scale`, the smallest of what it divides
/// by. A central difference with a step of cbrt(eps) scale is good to eps^(2/3) times f'''; a hundred covers
/// the factors of a third derivative of a quotient with a fourth power below.
struct Differences {
  explicit Differences(const Moments& s)
      : scale(std::min(s[S1], s[SXX] + s[SYY])), step(std::cbrt(0x1p-52) * scale) {}
  [[nodiscard]] double tolerance(double size) const {
    return 100 * std::pow(0x1p-52, 2.0 / 3) * size / scale;
  }
  double scale, step;
};

class SpinAt : public testing::TestWithParam<double> {
 protected:
  Spin spin_{{.lambda = GetParam(), .gamma_i = GetParam() == 0 ? 1.0 : 2.5}};
};

TEST_P(SpinAt, GradientMatchesCentralDifferences) {
  Random random(31);
  for (int trial = 0; trial < 20; ++trial) {
    const Moments s = random_solid(random);
    const Differences d(s);
    const Moments g = spin_.gradient(s);
    for (int k = 0; k < 10; ++k) {
      const Moments up = s + d.step * Moments::Unit(k), down = s - d.step * Moments::Unit(k);
      const double want = (spin_.value(up) - spin_.value(down)) / (up[k] - down[k]);
      EXPECT_NEAR(g[k], want, d.tolerance(spin_.value(s))) << moment_names[k] << ", trial " << trial;
    }
  }
}

TEST_P(SpinAt, HessianMatchesCentralDifferencesOfTheGradient) {
  Random random(32);
  for (int trial = 0; trial < 20; ++trial) {
    const Moments s = random_solid(random);
    const Differences d(s);
    const Matrix10 h = spin_.hessian(s);
    const double size = spin_.gradient(s).cwiseAbs().maxCoeff();
    for (int k = 0; k < 10; ++k) {
      const Moments up = s + d.step * Moments::Unit(k), down = s - d.step * Moments::Unit(k);
      const Moments want = (spin_.gradient(up) - spin_.gradient(down)) / (up[k] - down[k]);
      for (int i = 0; i < 10; ++i)
        EXPECT_NEAR(h(i, k), want[i], d.tolerance(size)) << moment_names[i] << ", " << moment_names[k];
    }
  }
}

TEST_P(SpinAt, HessianIsSymmetric) {
  Random random(33);
  const Matrix10 h = spin_.hessian(random_solid(random));
  // Mirror entries are the same products in another order.
  EXPECT_LE((h - h.transpose()).cwiseAbs().maxCoeff(), 8 * 0x1p-53 * h.cwiseAbs().maxCoeff());
}

TEST_P(SpinAt, ValueDoesNotDependOnDensity) {
  Random random(34);
  const Moments s = random_solid(random);
  EXPECT_NEAR(spin_.value(scaled(s, 1, 7.25)), spin_.value(s), 32 * 0x1p-53 * spin_.value(s));
}

INSTANTIATE_TEST_SUITE_P(Lambda, SpinAt, testing::Values(0.0, 0.7),
                         [](const auto& p) { return p.param == 0 ? "zero" : "positive"; });

TEST(Spin, InertiaTermDoesNotDependOnSizeAndTheHeightTermGrowsWithIt) {
  Random random(35);
  const Moments s = random_solid(random);
  const Spin flat({.lambda = 0, .gamma_i = 1}), high({.lambda = 0.7, .gamma_i = 1});
  const Moments large = scaled(s, 3, 1);
  const double rounding = 64 * 0x1p-53 * high.value(large);
  EXPECT_NEAR(flat.value(large), flat.value(s), rounding);
  EXPECT_NEAR(high.value(s) - flat.value(s), 0.7 * centre_of_mass(s)[2], rounding);
  EXPECT_NEAR(high.value(large) - flat.value(large), 3 * 0.7 * centre_of_mass(s)[2], rounding);
}

TEST(Spin, ValueIsTheInertiaRatioOfABodyOnItsAxis) {
  // RayRep, eq. 8: with the centre of mass on the axis, J is the upper block of the inertia about it.
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix();  // so that Ixy is not zero
  const Moments s = transformed(box_moments(Vec3::Zero(), {2, 1, 0.5}), turn, {0, 0, 0.75});
  const Eigen::Matrix3d j = inertia_about_centre(s);
  ASSERT_GT(std::abs(j(0, 1)), 0.01);
  const double want = (j(0, 0) * j(0, 0) + j(1, 1) * j(1, 1) + 2 * j(0, 1) * j(0, 1)) / (j(2, 2) * j(2, 2));
  EXPECT_NEAR(Spin({.lambda = 0, .gamma_i = 3}).value(s), 3 * want, 3 * 64 * 0x1p-53 * want);
}

TEST(Spin, ViolationIsTheLargestOfItsFourConstraints) {
  const Spin spin({});
  EXPECT_EQ(spin.constraints().matrix.rows(), 4);
  EXPECT_EQ(spin.constraints().names.size(), 4u);
  EXPECT_EQ(violation(spin, box_moments({0, 0, 3}, {1, 2, 0.5})), 0);
  const std::array<bool, 10> constrained = {false, true, true, false, false, true, true, false, false, false};
  for (int k = 0; k < 10; ++k)
    for (const double size : {0.25, -0.5}) {
      Moments s = Moments::Zero();
      s[S1] = 1;
      s[k] += size;
      EXPECT_EQ(violation(spin, s), constrained[static_cast<std::size_t>(k)] ? std::abs(size) : 0)
          << moment_names[k];
    }
}

// Discs and towers in body units; 50 mm a length.
constexpr double length_mm = 50;

TEST(SpinVerdict, AFlatBoxSpinsAboveItsCriticalSpeed) {
  const double a = 2, h = 0.25;  // volume one
  const Verdict verdict = Spin({}).verify(box_moments({0, 0, h / 2}, {a, a, h}), length_mm);
  EXPECT_TRUE(verdict.ok);
  EXPECT_EQ(verdict.text.find("spins: centre of mass 0.000 mm off the axis"), 0u) << verdict.text;
  EXPECT_NE(verdict.text.find("stable above"), std::string::npos) << verdict.text;
  // By hand: Izz = 8/12, Ixx = (4 + 1/16)/12 per mass and L^2; omega^2 = g c / ((Izz - Ixx) L) [SpinIt, eq.
  // 1].
  const double difference = (8 - 4.0625) / 12;
  const double omega = std::sqrt(9.80665 * (h / 2) / (difference * length_mm * 1e-3));
  const double rpm = omega * 60 / (2 * std::numbers::pi);
  EXPECT_NEAR(verdict.values.at("omega_min_rpm"), rpm, 1e-12 * rpm);
  EXPECT_NEAR(rpm, 82.54, 0.005) << "the figure itself, from a pocket calculator";
  EXPECT_NEAR(verdict.values.at("largest_over_lateral"), 8 / 4.0625, 1e-14);
  EXPECT_NEAR(verdict.values.at("centre_of_mass_z_mm"), 6.25, 1e-13);
  EXPECT_NEAR(verdict.values.at("tilt_degrees"), 0, 1e-6) << "asin of an eigenvector's round-off";
}

TEST(SpinVerdict, CriticalSpeedCountsTheLargerLateralMoment) {
  const Verdict verdict = Spin({}).verify(box_moments({0, 0, 0.25}, {2, 1, 0.5}), length_mm);
  EXPECT_TRUE(verdict.ok);
  const double difference = ((4 + 1) - (4 + 0.25)) / 12;
  const double rpm = std::sqrt(9.80665 * 0.25 / (difference * 0.05)) * 60 / (2 * std::numbers::pi);
  EXPECT_NEAR(verdict.values.at("omega_min_rpm"), rpm, 1e-12 * rpm);
}

TEST(SpinVerdict, SaysFromWhichSpeedOnTheSpectrumIsStable) {
  const Verdict verdict = Spin({}).verify(box_moments({0, 0, 0.2}, {2, 1, 0.5}), length_mm);
  // Gliding and of unequal moments: that of eq. 1. Held: moments about the tip, M l^2 larger.
  const double omega = verdict.values.at("omega_min_rpm"), tip = 0.2 * 0.2;
  EXPECT_NEAR(verdict.values.at("gliding_stable_above_rpm"), omega, 1e-12 * omega);
  const double difference = 5.0 / 12 - 4.25 / 12, about_tip = difference - tip;
  ASSERT_GT(about_tip, 0);
  const double held = omega * std::sqrt(difference / about_tip);
  EXPECT_NEAR(verdict.values.at("held_stable_above_rpm"), held, 1e-9 * held);
  EXPECT_NE(verdict.text.find("(spectrum: gliding above "), std::string::npos) << verdict.text;

  const Verdict tower = Spin({}).verify(box_moments({0, 0, 2}, {0.5, 0.5, 4}), length_mm);
  EXPECT_GT(tower.values.at("gliding_stable_above_rpm"), 0) << "eq. 1 knows of no such sleeping tops";
}

TEST(SpinVerdict, ABodyBelowItsContactPointSpinsAtAnySpeed) {
  const Verdict verdict = Spin({}).verify(box_moments({0, 0, -0.5}, {2, 2, 0.25}), length_mm);
  EXPECT_TRUE(verdict.ok);
  EXPECT_TRUE(std::isnan(verdict.values.at("omega_min_rpm")));
  EXPECT_EQ(verdict.text.find("stable above"), std::string::npos) << verdict.text;
}

void expect_failure(const Moments& s, const std::string& reason) {
  const Verdict verdict = Spin({}).verify(s, length_mm);
  EXPECT_FALSE(verdict.ok);
  EXPECT_EQ(verdict.text.find("does not spin (" + reason + "):"), 0u) << verdict.text;
}

TEST(SpinVerdict, ATallBoxDoesNotSpinBecauseItsMomentIsNotTheLargest) {
  const Moments tower = box_moments({0, 0, 2}, {0.5, 0.5, 4});
  expect_failure(tower, "Izz is not the largest principal moment");
  const Verdict verdict = Spin({}).verify(tower, length_mm);
  EXPECT_TRUE(std::isnan(verdict.values.at("omega_min_rpm")));
  EXPECT_NEAR(verdict.values.at("largest_over_lateral"), 0.5 / 16.25, 1e-14);
}

TEST(SpinVerdict, ABoxWithAMiddleMomentDoesNotSpin) {
  expect_failure(box_moments({0, 0, 0.5}, {2, 0.5, 1}), "Izz is not the largest principal moment");
}

TEST(SpinVerdict, AShiftedDiscDoesNotSpin) {
  expect_failure(box_moments({0.02, 0, 0.125}, {2, 2, 0.25}),
                 "centre of mass off the axis by more than 1e-3 L");
  const Verdict near = Spin({}).verify(box_moments({0.0006, -0.0007, 0.125}, {2, 2, 0.25}), length_mm);
  EXPECT_TRUE(near.ok) << near.text;
  EXPECT_NEAR(near.values.at("off_axis"), std::hypot(0.0006, 0.0007), 1e-15);
  EXPECT_NEAR(near.values.at("off_axis_mm"), 50 * std::hypot(0.0006, 0.0007), 1e-13);
  EXPECT_FALSE(Spin({}).verify(box_moments({0.0009, -0.0009, 0.125}, {2, 2, 0.25}), length_mm).ok);
}

TEST(SpinVerdict, ATiltedDiscDoesNotSpinAndItsTiltIsMeasured) {
  const Moments disc = box_moments({0, 0, 0}, {2, 2, 0.25});
  for (const double degrees : {5.0, 30.0, 0.11}) {
    const Moments tilted = transformed(disc, about_x(degrees), {0, 0, 0.125});
    expect_failure(tilted, "axis not principal within 0.1 degrees");
    EXPECT_NEAR(Spin({}).verify(tilted, length_mm).values.at("tilt_degrees"), degrees, 1e-9);
  }
  EXPECT_TRUE(Spin({}).verify(transformed(disc, about_x(0.09), {0, 0, 0.125}), length_mm).ok);
}

TEST(SpinVerdict, EveryFailureIsNamed) {
  const Moments tower = transformed(box_moments({0, 0, 0}, {0.5, 0.5, 4}), about_x(3), {0.1, 0, 2});
  expect_failure(
      tower,
      "centre of mass off the axis by more than 1e-3 L; axis not principal within 0.1 degrees; Izz "
      "is not the largest principal moment");
}

TEST(MakeProblem, TakesItsSettings) {
  const Moments s = box_moments({0, 0, 1}, {2, 2, 0.25});
  const auto plain = make_problem("spin", {}, Body{});
  EXPECT_EQ(plain->name(), "spin");
  const auto both = make_problem("spin", {{"lambda", "0.5"}, {"gamma_i", "2"}}, Body{});
  EXPECT_NEAR(both->value(s), 2 * plain->value(s) + 0.5, 64 * 0x1p-53);
}

void refuses(const std::string& name, const SettingTexts& settings, const std::string& part) {
  try {
    (void)make_problem(name, settings, Body{});
    FAIL() << "accepted; expected: " << part;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("expected"), std::string::npos) << e.what();
  }
}

TEST(MakeProblem, RefusesUnknownNamesAndUnfitSettings) {
  refuses("spinn", {}, "problem 'spinn' is unknown (did you mean 'spin'?); expected one of: spin");
  refuses("spin", {{"lamda", "1"}},
          "problem.lamda = 1; spin has no setting of that name (did you mean lambda?)");
  refuses("spin", {{"lambda", "-1"}}, "problem.lambda = '-1'; expected");
  refuses("spin", {{"gamma_i", "0"}}, "problem.gamma_i = '0'; expected");
  refuses("spin", {{"lambda", "nan"}}, "problem.lambda = 'nan'");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
