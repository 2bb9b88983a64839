// fall_test.cpp - the tilted plane and the yo-yo.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/test_bodies.hpp"
#include "physics/tilting_plane.hpp"
#include "physics/yoyo_fall.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(TiltingPlane, TopplesABoxOverItsEdgesAndCorners) {
  const SupportPolygon base = hull_of({{-1, -2}, {1, -2}, {1, 2}, {-1, 2}});
  const Vec3 centre(0.25, 0, 3);
  const auto all = tilt_the_plane(base, 0.5, centre, 360);
  EXPECT_NEAR(all[0].angle, std::atan(0.75 / 2.5), 1e-12) << "towards +x";
  EXPECT_NEAR(all[180].angle, std::atan(1.25 / 2.5), 1e-12) << "towards -x";
  EXPECT_NEAR(all[90].angle, std::atan(2 / 2.5), 1e-12) << "towards +y";
  EXPECT_NEAR(all[45].angle, std::atan(0.75 * std::sqrt(2.0) / 2.5), 1e-12) << "askew over the same edge";
  EXPECT_EQ(worst(all).azimuth, 0);
  EXPECT_EQ(worst(tilt_the_plane(base, 0, Vec3(1.5, 0, 1))).angle, 0) << "it falls on level ground";
}

TEST(YoyoFall, IsSlowerTheSlimmerTheAxle) {
  const Moments s = moments_of(0.5, 0, {0.06, 0.06, 0.1});
  const double radius = 0.1, k = 0.1 / (0.5 * radius * radius);
  const YoyoFall fall = yoyo_fall(s, radius);
  EXPECT_NEAR(fall.acceleration, 1 / (1 + k), 1e-15);
  EXPECT_NEAR(fall.tension, 1 - fall.acceleration, 1e-15);
  EXPECT_NEAR(fall.turning * radius, fall.acceleration, 1e-15) << "without slipping";
  // v^2 = 2 a h, as at constant acceleration.
  EXPECT_NEAR(std::pow(speed_after(s, radius, 3) * radius, 2), 2 * fall.acceleration * 3, 1e-12);
  EXPECT_NEAR(yoyo_fall(s, 1e6).acceleration, 1, 1e-9);
  expect_refusal([&] { (void)yoyo_fall(s, 0); }, "an axle", {});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
