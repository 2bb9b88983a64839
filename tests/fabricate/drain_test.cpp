#include "fabricate/drain.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "body/mesh_moments.hpp"
#include "body/models/geodesic.hpp"
#include "error.hpp"
#include "geometry/moved.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/components.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace {

TriangleMesh ball(double radius) { return moved(geodesic_sphere(12), Eigen::Scaling(radius)); }

double volume(const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value[S1]; }

TEST(Drain, OpensAHollowBallBelow) {
  const TriangleMesh outer = ball(10), cavity = inverted(ball(8));
  const double radius = 1;
  const std::vector<Drain> drains = drains_of(outer, cavity, radius, Vec3::UnitZ());
  ASSERT_EQ(drains.size(), 1u);
  EXPECT_GT(drains[0].along.dot(Vec3::UnitZ()), 0.9) << "from below";
  EXPECT_NEAR(drains[0].along.norm(), 1, 1e-12);
  const TriangleMesh part = drained(outer, cavity, drains, radius);
  EXPECT_NO_THROW(require_solid(part, "ball"));
  EXPECT_TRUE(self_intersections(part).empty());
  const std::vector<Shell> all = shells(part);
  ASSERT_EQ(all.size(), 1u) << "outside and inside are one surface";
  EXPECT_EQ(all[0].genus, 0);
  // A round hole through the wall; of triangles of a third of its radius, it may be that much narrower or
  // wider.
  const double hole = volume(outer) + volume(cavity) - volume(part);
  EXPECT_NEAR(hole, std::numbers::pi * radius * radius * 2, std::numbers::pi * 2 * (4.0 / 9 + 1.0 / 9));
}

TEST(Drain, IsNotDrilledWhereNothingLiesBehindTheWall) {
  const TriangleMesh outer = ball(10), cavity = inverted(ball(8));
  EXPECT_THROW((void)drained(outer, cavity, {{{0, 0, 30}, Vec3::UnitZ()}}, 1), InputError);
  EXPECT_TRUE(drains_of(outer, {}, 1, Vec3::UnitZ()).empty()) << "no void";
}

}  // namespace
}  // namespace kreisel::core
