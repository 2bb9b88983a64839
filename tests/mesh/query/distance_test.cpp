#include "mesh/query/distance.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace {

const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);

TEST(DistanceToTriangle, IsExactInEveryRegionAroundIt) {
  const auto distance = [](const Vec3& p) { return distance_to_triangle(p, a, b, c); };
  EXPECT_EQ(distance({1, 1, 3}), 3) << "above the face";
  EXPECT_EQ(distance({1, 1, -3}), 3) << "below the face";
  EXPECT_EQ(distance({1, 1, 0}), 0) << "on the face";
  EXPECT_EQ(distance({2, -3, 4}), 5) << "beside ab";
  EXPECT_EQ(distance({-4, 1, 3}), 5) << "beside ca";
  EXPECT_DOUBLE_EQ(distance({4, 4, 0}), std::sqrt(8.0)) << "beside bc";
  EXPECT_EQ(distance({-3, -4, 0}), 5) << "corner a";
  EXPECT_EQ(distance({7, 0, 4}), 5) << "corner b";
  EXPECT_EQ(distance({0, 8, 3}), 5) << "corner c";
  EXPECT_EQ(distance(a), 0);
  EXPECT_EQ(distance({2, 0, 0}), 0) << "on an edge";
}

TEST(DistanceToTriangle, DoesNotDependOnTheOrderOfCorners) {
  Random random(21);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 p = random_vec(random, -2, 2), u = random_vec(random, -1, 1), v = random_vec(random, -1, 1),
               w = random_vec(random, -1, 1);
    const double d = distance_to_triangle(p, u, v, w);
    // Cross products of differences of order one; slim triangles lose some digits, hence 2^-40.
    for (const double other : {distance_to_triangle(p, v, w, u), distance_to_triangle(p, w, u, v),
                               distance_to_triangle(p, v, u, w)})
      EXPECT_NEAR(other, d, 0x1p-40);
  }
}

TEST(DistanceToTriangle, IsNeverMoreThanToAnyOfItsPoints) {
  Random random(22);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 p = random_vec(random, -2, 2), u = random_vec(random, -1, 1), v = random_vec(random, -1, 1),
               w = random_vec(random, -1, 1);
    const double d = distance_to_triangle(p, u, v, w);
    double least = std::numeric_limits<double>::infinity();
    constexpr int steps = 60;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
        least = std::min(least, (p - (u + s * (v - u) + t * (w - u))).norm());
      }
    EXPECT_LE(d, least + 0x1p-40);
    // The samples are at most one step of an edge (<= 2 sqrt 3) apart.
    EXPECT_GE(d, least - 2 * std::sqrt(3.0) / steps);
  }
}

TEST(DistanceToTriangle, OfADegenerateOneIsThatToItsSegmentOrPoint) {
  EXPECT_EQ(distance_to_triangle({1, 3, 4}, a, b, b), 5) << "segment";
  EXPECT_EQ(distance_to_triangle({1, 3, 4}, a, {2, 0, 0}, b), 5) << "three points in a line";
  EXPECT_EQ(distance_to_triangle({0, 3, 4}, a, a, a), 5) << "point";
}

double brute_force(const TriangleMesh& mesh, const Vec3& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles)
    best = std::min(best,
                    distance_to_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
  return best;
}

TEST(SurfaceDistance, IsThatOfTheNearestTriangleOrTheLimit) {
  Random random(23);
  // Away from the origin, single precision rounds coarsely: what the margin is for.
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(100, -200, 50)}) {
    const TriangleMesh mesh = moved(upright_torus_mesh(0.75, 0.25, 48, 24), random_rotation(random), shift);
    const SurfaceDistance distance(mesh);
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 p = shift + random_vec(random, -1.2, 1.2);
      const double want = brute_force(mesh, p);
      EXPECT_EQ(distance(p, 10), want) << "the very same arithmetic on the same triangle";
      EXPECT_EQ(distance(p, 0.1), std::min(want, 0.1));
      if (want > 0) {
        EXPECT_EQ(distance(p, want * (1 + 0x1p-50)), want) << "a limit just above";
      }
    }
  }
}

TEST(SurfaceDistance, EndsTheSearchOnlyWithWhatIsNearEnough) {
  Random random(24);
  const TriangleMesh mesh = upright_torus_mesh(0.75, 0.25, 48, 24);
  const SurfaceDistance distance(mesh);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 p = random_vec(random, -1.2, 1.2);
    const double want = brute_force(mesh, p);
    const double got = distance(p, 1, 0.2);
    if (want < 0.2) {
      EXPECT_GE(got, want);
      EXPECT_LT(got, 0.2);
    } else {
      EXPECT_EQ(got, std::min(want, 1.0));
    }
    EXPECT_EQ(distance(p, 0.2, 0.2) < 0.2, want < 0.2) << "as a yes or no";
  }
}

TEST(SurfaceDistance, NamesTheNearestTriangleWithinTheLimit) {
  Random random(25);
  const TriangleMesh mesh = upright_torus_mesh(0.75, 0.25, 48, 24);
  const SurfaceDistance distance(mesh);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 p = random_vec(random, -1.2, 1.2);
    const double want = brute_force(mesh, p);
    const auto near = distance.nearest(p, 10);
    ASSERT_TRUE(near);
    const Triangle& t = mesh.triangles[*near];
    EXPECT_EQ(distance_to_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]), want);
    if (want > 0) {
      EXPECT_FALSE(distance.nearest(p, want)) << "none is nearer than itself";
    }
  }
}

TEST(SurfaceDistance, OnAVertexIsZero) {
  const TriangleMesh mesh = box_mesh({0.1, 0.2, 0.3}, {1, 1, 1});
  const SurfaceDistance distance(mesh);
  for (const Vec3& v : mesh.vertices) EXPECT_EQ(distance(v, 1), 0);
}

}  // namespace
}  // namespace kreisel::core
