#include "fabricate/parting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/models/geodesic.hpp"
#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Parting, OfABallIsAnyPlaneThroughItsMiddle) {
  const Parting parting = least_undercut(geodesic_sphere(12));
  EXPECT_EQ(parting.undercut, 0);
  EXPECT_NEAR(parting.offset, 0, 1e-6);
  EXPECT_NEAR(parting.normal.norm(), 1, 1e-12);
}

TEST(Parting, OffTheMiddleOfABallHoldsBackWhatIsUnderItsWidest) {
  // With the plane at z = h > 0, lines at a radius above r0 = sqrt(1 - h^2) have the ball below the plane
  // alone. The lower half of the mould goes from the ball up to the plane there: that is what it holds back.
  const double h = 0.5, pi = std::numbers::pi, r0_squared = 1 - h * h;
  const double ring = pi * (1 - r0_squared) * h - 2 * pi / 3 * std::pow(1 - r0_squared, 1.5);
  EXPECT_NEAR(undercut(geodesic_sphere(40), Vec3::UnitZ(), h, 200), ring, 0.02 * ring);
}

TEST(Parting, OfTwoBoxesAboveEachOtherHoldsBackTheGap) {
  const TriangleMesh boxes = both(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({0, 0, 2}, {1, 1, 3}));
  for (const double offset : {0.5, 1.5, 2.5})
    EXPECT_NEAR(undercut(boxes, Vec3::UnitZ(), offset), 1, 1e-5) << offset;
  EXPECT_NEAR(undercut(boxes, {2, 0, 0}, 0.3), 0, 1e-5) << "a normal of any length";
}

TEST(Parting, OfALetterIsAcrossItsStroke) {
  Random random(3);
  const Eigen::Matrix3d turn = random_rotation(random);
  const Parting parting = least_undercut(moved(letter_c_mesh(1), turn, Vec3::Zero()));
  // Drawn apart along y nothing is held back; one of a hundred directions is within ten degrees of that, and
  // a stroke of 1 that leans by so much holds back its tangent's share.
  EXPECT_GT(std::abs(parting.normal.dot(turn.col(1))), 0.98);
  EXPECT_LT(parting.undercut, 0.3);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
