// spin_check_test.cpp - the check of a finished body: units, verdicts and refusals.
#include "physics/spin_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/test_bodies.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const Moments top = moments_of(0.4, 0.6, {0.08, 0.08, 0.12});

TEST(CheckSpin, SpeaksOfRevolutionsPerMinuteAndSeconds) {
  // 40 mm to a body length; the sleeping top of c^2 w^2 = 4 a M g l.
  const double length = 0.04, g = 9.80665, mass = 0.4;
  const double w = 2 * std::sqrt(0.08 * mass * g * 0.6 / length) / 0.12, rpm = w * 30 / std::numbers::pi;
  SpinCheckOptions options;
  options.rpm = 1.1 * rpm;
  options.seconds = 3;
  options.scan_rpm = {0.5 * rpm, 0.9 * rpm, 1.1 * rpm};
  const SpinCheck check = check_spin(top, 1e3 * length, options);
  const auto& gliding = check.stable_rpm[0];
  ASSERT_EQ(gliding.size(), 1u);
  EXPECT_NEAR(gliding[0].low, rpm, 1e-9 * rpm);
  EXPECT_TRUE(check.at_speed.stable());
  EXPECT_TRUE(check.at_speed.stays());
  EXPECT_EQ(check.motion.times.back(), 3);
  EXPECT_NEAR(check.motion.tilts.front(), 1, 1e-12);
  ASSERT_EQ(check.scan.size(), 3u);
  EXPECT_TRUE(check.scan[0].steady && !check.scan[0].stable() && check.scan[0].fell_at);
  EXPECT_FALSE(check.scan[1].stable() || check.scan[1].stays());
  EXPECT_TRUE(check.scan[2].stable() && check.scan[2].stays());
  EXPECT_NEAR(check.scan[2].largest_tilt, check.at_speed.largest_tilt, 1e-3) << "of other steps";
  EXPECT_EQ(describe({{480.2, 510.04}, {612.44, INFINITY}}), "480.2 to 510.0, above 612.4 rpm");
  EXPECT_FALSE(std::signbit(check.stable_rpm[2][0].low));
  EXPECT_EQ(describe(check.stable_rpm[2]), "at any speed") << "free, about the largest axis";
  EXPECT_EQ(describe({}), "at no speed");
}

TEST(CheckSpin, FindsNoSteadySpinOfWhatIsOutOfBalance) {
  const Moments askew = moments_of(
      0.4, Vec3(0.1, 0, 0.6), (Eigen::Matrix3d() << 0.09, 0, 0.03, 0, 0.09, 0, 0.03, 0, 0.12).finished());
  SpinCheckOptions options;
  options.rpm = 1000;
  options.seconds = 1;
  const SpinCheck check = check_spin(askew, 40, options);
  EXPECT_FALSE(check.at_speed.steady);
  EXPECT_FALSE(check.at_speed.stable() || check.at_speed.stays());
}

TEST(CheckSpin, RefusesOptionsInOneLine) {
  const auto refused = [](auto change, const char* start) {
    SpinCheckOptions options;
    options.rpm = 500;
    change(options);
    expect_refusal([&] { (void)check_spin(top, 40, options); }, start, {});
  };
  refused([](auto& o) { o.rpm = -300; }, "a speed of -300");
  refused([](auto& o) { o.rpm = 0; }, "a speed of 0");
  refused([](auto& o) { o.tilt_degrees = 0; }, "a tilt of 0");
  refused([](auto& o) { o.tilt_degrees = 10; }, "a tilt of 10");
  refused([](auto& o) { o.seconds = -1; }, "-1 seconds");
  refused([](auto& o) { o.seconds = 1e9; }, "simulation in");
  refused([](auto& o) { o.scan_rpm = {100, NAN}; }, "a speed of nan");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
