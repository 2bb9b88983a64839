#include "geometry/plane.hpp"

#include <gtest/gtest.h>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Plane, SaysOnWhichSideAPointLies) {
  const Plane plane{{0, 3, 4}, 10};
  EXPECT_EQ(plane.above({7, 2, 1}), 0);
  EXPECT_EQ(plane.above({0, 3, 4}), 15) << "three lengths of the normal above";
  EXPECT_EQ(plane.reversed().above({0, 3, 4}), -15);
}

TEST(Plane, GoesAlongWithARotation) {
  Random random(41);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Matrix3d turn = random_rotation(random);
    const Plane plane{random_vec(random, -1, 1), uniform(random, -1, 1)};
    const Vec3 x = random_vec(random, -1, 1);
    EXPECT_NEAR(plane.turned(turn).above(turn * x), plane.above(x), 16 * 0x1p-52);
  }
}

TEST(HalfView, SeesTheHalfAlongItsWay) {
  Random random(42);
  for (int trial = 0; trial < 20; ++trial) {
    const Plane half{random_vec(random, -1, 1).normalized(), uniform(random, -1, 1)};
    const Vec3 way = random_vec(random, -1, 1).normalized(), x = random_vec(random, -1, 1);
    const HalfView view(half, way);
    EXPECT_NEAR((view.into(x + way) - view.into(x) - Vec3::UnitZ()).norm(), 0, 16 * 0x1p-52);
    EXPECT_NEAR((view.out_of(view.into(x)) - x).norm(), 0, 16 * 0x1p-52);
    EXPECT_NEAR(view.cut.above(view.into(x)), half.above(x), 16 * 0x1p-52);
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
