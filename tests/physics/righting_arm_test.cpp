// righting_arm_test.cpp - GZ curves against the closed forms of a box and of a sphere.
#include "physics/righting_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/hydrostatics.hpp"
#include "body/test_meshes.hpp"
#include "physics/units.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(RightingArm, OfABoxFollowsTheWallSidedFormula) {
  // While deck and bottom stay out of the waterline: GZ = sin h (GM + BM tan^2 h / 2). [any naval
  // architecture]
  const double length = 10, width = 4, depth = 3, draft = 1.5, centre = 1.2;
  const TriangleMesh box = box_mesh({-length / 2, -width / 2, 0}, {length / 2, width / 2, depth});
  const Afloat afloat{box, Vec3(0, 0, centre), length * width * draft};
  const double bm = width * width / (12 * draft), gm = draft / 2 + bm - centre;
  for (const double heel : {0.05, 0.2, 0.5})  // the deck goes under at atan(2 x 1.5 / 4) = 0.64
    EXPECT_NEAR(righting_arm_at(afloat, 0, heel),
                std::sin(heel) * (gm + bm * std::pow(std::tan(heel), 2) / 2), 1e-12);
  EXPECT_NEAR(righting_arm_at(afloat, 0, -0.2), -righting_arm_at(afloat, 0, 0.2), 1e-12);
  // About the other axis its length counts.
  EXPECT_NEAR(righting_arm(afloat, std::numbers::pi / 2, 4).metacentric_height,
              draft / 2 + length * length / (12 * draft) - centre, 1e-6);

  const RightingArm arm = righting_arm(afloat, 0, 180);
  EXPECT_NEAR(arm.metacentric_height, gm, 1e-6);
  EXPECT_NEAR(hydrostatics(box, draft).metacentre() - centre, gm, 1e-12);
  ASSERT_TRUE(arm.vanishing);
  EXPECT_NEAR(righting_arm_at(afloat, 0, *arm.vanishing), 0, 1e-4) << "a thousandth of a degree off";
  EXPECT_GT(righting_arm_at(afloat, 0, *arm.vanishing - 0.05), 0);
  EXPECT_LT(righting_arm_at(afloat, 0, *arm.vanishing + 0.05), 0);
  EXPECT_NEAR(arm.gz.back(), 0, 1e-12) << "upside down it is level again";
}

TEST(RightingArm, OfABodyOfRevolutionAboutItsAxisIsThatOfItsWeightAlone) {
  // Turned about its own axis, water sees no change: GZ = (axis above the centre of mass) sin h.
  TriangleMesh roller;
  constexpr int sides = 720;
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * std::numbers::pi * i / sides;
    for (const double x : {-2.0, 2.0}) roller.vertices.emplace_back(x, std::cos(a), std::sin(a));
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    roller.triangles.push_back({a, b, a + 1});
    roller.triangles.push_back({b, b + 1, a + 1});
    if (i > 0 && i + 1 < sides) {
      roller.triangles.push_back({0, b, a});
      roller.triangles.push_back({1, a + 1, b + 1});
    }
  }
  const Afloat afloat{roller, Vec3(0, 0, -0.3), 5.0};
  const RightingArm arm = righting_arm(afloat, 0, 12);
  for (std::size_t i = 0; i < arm.heel.size(); ++i)
    EXPECT_NEAR(arm.gz[i], 0.3 * std::sin(arm.heel[i]), 1e-4) << "facets of 1 / 720 of the circle";
  EXPECT_FALSE(arm.vanishing) << "it returns from any heel";
  EXPECT_FALSE(righting_arm({roller, Vec3(0, 0, 0.3), 5.0}, 0, 12).vanishing) << "it is not righted at all";
}

TEST(RightingArm, RefusesWhatSinks) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  expect_refusal([&] { (void)righting_arm({box, Vec3(0.5, 0.5, 0.5), 1.5}, 0); }, "righting arm", {"1.5"});
  expect_refusal([&] { (void)righting_arm({box, Vec3(0.5, 0.5, 0.5), 0}, 0); }, "righting arm", {});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
