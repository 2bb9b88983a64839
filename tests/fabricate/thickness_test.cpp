#include "fabricate/thickness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/moved.hpp"
#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace {

TEST(ThinnestMaterial, IsTheWebBetweenTwoVoidsWhereThatIsThinnerThanTheWall) {
  const TriangleMesh outer = box_mesh(Vec3::Zero(), Vec3::Constant(10));
  for (const double web : {0.3, 0.7}) {
    const TriangleMesh voids =
        both(inverted(box_mesh({1, 1, 1}, {5, 9, 9})), inverted(box_mesh({5 + web, 1, 1}, {9, 9, 9})));
    const ThinPlace found = thinnest_material(outer, voids);
    EXPECT_NEAR(found.thickness, web, 1e-5) << "single precision of coordinates up to 10";
    EXPECT_TRUE(std::abs(found.at[0] - 5) < 1e-9 || std::abs(found.at[0] - 5 - web) < 1e-9);
  }
}

TEST(ThinnestMaterial, IsTheWallOfASingleVoid) {
  const TriangleMesh outer = box_mesh(Vec3::Zero(), Vec3::Constant(10));
  EXPECT_NEAR(thinnest_material(outer, inverted(box_mesh({1, 2, 0.6}, {9, 8, 8}))).thickness, 0.6, 1e-5);
}

TEST(ThinnestMaterial, IsRightFarFromTheOrigin) {
  for (const double away : {0.0, 2e3, 2e4, 5e8}) {
    const auto there = [&](TriangleMesh mesh) {
      return moved(std::move(mesh), Eigen::Translation3d(away, -0.7 * away, 0.1 * away));
    };
    const TriangleMesh outer = there(box_mesh(Vec3::Zero(), Vec3::Constant(10)));
    const double found =
        thinnest_material(outer, there(inverted(box_mesh({1, 2, 0.625}, {9, 8, 8})))).thickness;
    // Corners and a ray's start are rounded to 6e-8 of themselves at 5e8.
    EXPECT_NEAR(found, 0.625, 1e-9 + 4e-16 * away) << away;
  }
}

TEST(ThinnestMaterial, IsInfiniteWithoutACavity) {
  EXPECT_TRUE(std::isinf(thinnest_material(box_mesh(Vec3::Zero(), Vec3::Ones()), {}).thickness));
}

}  // namespace
}  // namespace kreisel::core
