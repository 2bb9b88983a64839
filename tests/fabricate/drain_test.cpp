#include "fabricate/drain.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "body/mesh_moments.hpp"
#include "body/models/geodesic.hpp"
#include "error.hpp"
#include "geometry/moved.hpp"
#include "mesh/make/refine.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/components.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace THIS_FILE {

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

TEST(Drain, OpensABlockOfTwelveTriangles) {
  const TriangleMesh outer = box_mesh({0, 0, 0}, {40, 30, 20});
  const TriangleMesh cavity = inverted(box_mesh({2, 2, 2}, {38, 28, 18}));
  for (const double radius : {0.5, 3.0}) {
    // The cavity's corners are the only places there are, and a hole there would run along its walls.
    EXPECT_TRUE(drains_of(outer, cavity, radius, Vec3::UnitZ()).empty());
    const TriangleMesh part = drained(outer, cavity, {{{20, 15, 0}, Vec3::UnitZ()}}, radius);
    EXPECT_NO_THROW(require_solid(part, "block"));
    EXPECT_TRUE(self_intersections(part).empty());
    EXPECT_LT(part.triangles.size(), 5000u) << "two discs of a few hundred triangles, and what leads to them";
  }
}

TEST(Drain, OpensWhereItsAxisRunsThroughEdgesAndCorners) {
  // A lattice on every face, in step with the halves and quarters of the block's edges.
  TriangleMesh cavity = box_mesh({4, 4, 4}, {28, 28, 28});
  split_edges(cavity, [](const Vec3& a, const Vec3& b) { return (b - a).norm() > 3; });
  const TriangleMesh outer = box_mesh({0, 0, 0}, {32, 32, 32});
  const std::vector<Drain> drains = drains_of(outer, inverted(cavity), 1, Vec3::UnitZ());
  ASSERT_EQ(drains.size(), 1u);
  const TriangleMesh part = drained(outer, inverted(cavity), drains, 1);
  EXPECT_NO_THROW(require_solid(part, "block"));
  EXPECT_TRUE(self_intersections(part).empty());
}

TEST(Drain, IsNotDrilledWhereNothingLiesBehindTheWall) {
  const TriangleMesh outer = ball(10), cavity = inverted(ball(8));
  EXPECT_THROW((void)drained(outer, cavity, {{{0, 0, 30}, Vec3::UnitZ()}}, 1), InputError);
  EXPECT_TRUE(drains_of(outer, {}, 1, Vec3::UnitZ()).empty()) << "no void";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
