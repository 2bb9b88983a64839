#include "nest/decide/certify.hpp"

#include <gtest/gtest.h>

#include "nest/inside_ball.hpp"
#include "nest/known_answers.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

TEST(LargestNear, RaisesAScaleThatHoldsAndLowersOneThatDoesNot) {
  InsideBall exact;
  Placement placement;
  placement.pose.centroid = Vec3(0.4, 0, 0);  // 0.6 is the most
  for (const double scale : {0.45, 0.5999, 0.6002, 0.9}) {
    placement.pose.scale = scale;
    const CertifiedScale certified = largest_near(exact, placement);
    EXPECT_EQ(certified.confirmed, scale < 0.6);
    EXPECT_EQ(certified.verdict.valid(), scale < 0.6);
    EXPECT_LE(certified.scale, 0.6 + 1e-12) << "round-off of 0.4 + 0.6";
    EXPECT_GE(certified.scale, 0.6 - 1e-4);
    EXPECT_LT(certified.tests, 30);
  }
  placement.pose.centroid = Vec3(2, 0, 0);
  const CertifiedScale nowhere = largest_near(exact, placement);
  EXPECT_FALSE(nowhere.confirmed);
  EXPECT_EQ(nowhere.scale, 0);
}

TEST(CertifyScale, MissesNoScaleBetweenOthersThatDoNotHold) {
  // Of a thin ring in one hardly thicker only scales between 0.995 and 1.002 hold, a bit fewer for the
  // facets.
  const Nesting nesting(ring(0.7, 0.3), ring(0.7, 0.298));
  Placement placement;
  for (const double scale : {1.04, 1.1, 1.3}) {
    placement.pose.scale = scale;
    const CertifiedScale certified = certify_scale(nesting, placement);
    EXPECT_FALSE(certified.confirmed);
    EXPECT_FALSE(certified.verdict.valid());
    EXPECT_NEAR(certified.scale, 1 / 0.998, 1e-3) << scale;
  }
  placement.pose.scale = 1;
  EXPECT_TRUE(certify_scale(nesting, placement).confirmed);
  placement.pose.scale = 0.9;
  const CertifiedScale none = certify_scale(nesting, placement);
  EXPECT_FALSE(none.confirmed);
  EXPECT_EQ(none.scale, 0);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
