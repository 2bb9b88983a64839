#include "mesh/solid/simplify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "body/mesh_moments.hpp"
#include "body/test_meshes.hpp"
#include "mesh/make/refine.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/components.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// The farthest of these points from a surface.
double farthest(const std::vector<Vec3>& points, const TriangleMesh& surface) {
  const SurfaceDistance distance(surface);
  double most = 0;
  for (const Vec3& p : points) most = std::max(most, distance(p, 10));
  return most;
}

/// A surface of the same kind that does not run through itself.
void expect_same_kind(const TriangleMesh& before, const TriangleMesh& after) {
  const auto was = shells(before), is = shells(after);
  ASSERT_EQ(was.size(), is.size());
  for (std::size_t i = 0; i < was.size(); ++i) EXPECT_EQ(was[i].euler, is[i].euler);
  EXPECT_TRUE(self_intersections(after).empty());
}

double volume(const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value[S1]; }

TEST(Simplified, ARingKeepsItsHoleAndItsDistance) {
  const TriangleMesh ring = upright_torus_mesh(1, 0.4, 240, 120);  // 57600 triangles
  for (const double tolerance : {0.002, 0.01}) {
    const TriangleMesh few = simplified(ring, {.along = tolerance, .against = tolerance});
    expect_same_kind(ring, few);
    EXPECT_LE(farthest(ring.vertices, few), tolerance * (1 + 1e-9));
    // Its vertices are some of the others, and so its own distance from them is 0.
    EXPECT_LE(farthest(few.vertices, ring), 1e-12);
    // A mesh of triangles whose chords are off by d has edges of sqrt(8 d r): some 4 pi^2 R r / (7 d r).
    EXPECT_LT(few.triangles.size(), 3 * 4 * 10 * 1 / (7 * tolerance));
  }
}

TEST(Simplified, AFacetedBoxIsLeftWithFew) {
  TriangleMesh box = box_mesh({0, 0, 0}, {3, 2, 1});
  split_edges(box, [](const Vec3& a, const Vec3& b) { return (a - b).norm() > 0.1; });
  ASSERT_GT(box.triangles.size(), 4000u);
  const TriangleMesh few = simplified(box, {.along = 1e-3, .against = 1e-3});
  expect_same_kind(box, few);
  EXPECT_NEAR(volume(few), 6, 6 * 1e-3 * 22) << "no edge is off by more than the tolerance";
  EXPECT_LT(few.triangles.size(), box.triangles.size() / 20);
}

TEST(Simplified, GoesToTheSideThatIsAllowed) {
  // All of a ball's chords are within it: where no vertex may end outside, chords are allowed, where none may
  // end inside, nothing can go.
  const TriangleMesh ring = upright_torus_mesh(1, 0.4, 120, 60);
  const SurfaceTolerance in{.along = 0, .against = 0.01}, out{.along = 0.01, .against = 0};
  for (const SurfaceTolerance& side : {in, out}) {
    const TriangleMesh few = simplified(ring, side);
    EXPECT_LT(few.triangles.size(), ring.triangles.size());
    EXPECT_LE(farthest(ring.vertices, few), 0.01 * (1 + 1e-9));
    // A point of the ring is at (R + r cos b) about its axis: the outer half is round, where chords are
    // inside; the inner half is a saddle.
    EXPECT_EQ(volume(few) < volume(ring), side.against > 0);
  }
}

TEST(Simplified, WithoutAToleranceEverythingStays) {
  const TriangleMesh ring = upright_torus_mesh(1, 0.4, 40, 20);
  const TriangleMesh same = simplified(ring, {});
  EXPECT_EQ(same.triangles, ring.triangles);
}

TEST(Simplified, TurnedOverIsTheSameTurnedOver) {
  const TriangleMesh ring = upright_torus_mesh(1, 0.4, 60, 30);
  const SurfaceTolerance both{.along = 0.01, .against = 0.01};
  EXPECT_NEAR(volume(simplified(inverted(ring), both)), -volume(simplified(ring, both)), 0.01 * volume(ring));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
