#include "mesh/make/prism.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/mesh_moments.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Prism, OverACircleIsASolidOfThePolygonsArea) {
  constexpr int sides = 24;
  const double radius = 2, bottom = -1, top = 3;
  const TriangleMesh mesh = prism(circle(Vec2(5, -3), radius, sides), bottom, top);
  EXPECT_NO_THROW(require_solid(mesh, "prism"));
  const double area = sides / 2.0 * radius * radius * std::sin(2 * std::numbers::pi / sides);
  const Moments s = reference::mesh_moments(mesh).value;
  // Outward, or the volume would be negative; a hundred sums of terms of a hundred times the result.
  EXPECT_NEAR(s[S1], area * (top - bottom), 1e-12 * 100 * s[S1]);
  EXPECT_LT((centre_of_mass(s) - Vec3(5, -3, 1)).norm(), 1e-12 * 100);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
