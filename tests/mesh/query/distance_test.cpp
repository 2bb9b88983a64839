#include "mesh/query/distance.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "body/test_meshes.hpp"
#include "geometry/distance.hpp"

namespace kreisel::core {
namespace THIS_FILE {

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
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(100, -200, 50), Vec3(5e8, -3.5e8, 5e7)}) {
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

}  // namespace THIS_FILE
}  // namespace kreisel::core
