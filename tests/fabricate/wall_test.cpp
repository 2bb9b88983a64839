#include "fabricate/wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Wall, IsTheLeastDistanceOfTwoBoxes) {
  const TriangleMesh outer = box_mesh(Vec3::Zero(), Vec3::Constant(10));
  EXPECT_DOUBLE_EQ(least_wall(outer, box_mesh({1, 2, 3}, {8, 8, 8})), 1);
  EXPECT_DOUBLE_EQ(least_wall(outer, box_mesh({1, 2, 3}, {8, 8, 9.75})), 0.25);
}

TEST(Wall, IsFoundBetweenTheCornersOfTriangles) {
  // An upright needle, its tip 0.1 above the middle of a triangle.
  const TriangleMesh cavity = box_mesh({-3, -3, -1}, {0, 0, 0});
  const Triangle& top = *std::ranges::find_if(cavity.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return cavity.vertices[v][2] == 0; });
  });
  const Vec3 middle = (cavity.vertices[top[0]] + cavity.vertices[top[1]] + cavity.vertices[top[2]]) / 3;
  const TriangleMesh needle =
      moved(box_mesh({-0.01, -0.01, 0.1}, {0.01, 0.01, 5}), Eigen::Matrix3d::Identity(), middle);
  EXPECT_NEAR(least_wall(needle, cavity), 0.1, 1e-12);
}

TEST(Wall, WithinAPartLeavesOutWhatIsTheOuterSurface) {
  const TriangleMesh outer = box_mesh(Vec3::Zero(), Vec3::Constant(10)),
                     part = both(outer, inverted(box_mesh({1, 2, 3}, {8, 8, 9.75})));
  EXPECT_DOUBLE_EQ(least_wall_within(outer, part, 1e-4), 0.25);
  EXPECT_TRUE(std::isinf(least_wall_within(outer, outer, 1e-4)));
}

TEST(Wall, IsInfiniteWithoutACavity) {
  EXPECT_TRUE(std::isinf(least_wall(box_mesh(Vec3::Zero(), Vec3::Ones()), {})));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
