#include "deform/submerged.hpp"

#include <gtest/gtest.h>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Submerged, OfABoxIsTheBoxBelowTheSurface) {
  const TriangleMesh box = box_mesh({-1, 0, -2}, {3, 1, 2});
  const Moments s = submerged(box, 0.5);
  EXPECT_NEAR(s[S1], 4 * 1 * 2.5, 1e-12);
  EXPECT_NEAR(s[SX], 1 * 10, 1e-12);
  EXPECT_NEAR(s[SY], 0.5 * 10, 1e-12);
  EXPECT_NEAR(submerged(box, -3)[S1], 0, 1e-12);
  EXPECT_NEAR(submerged(box, 5)[S1], 16, 1e-12);
}

TEST(Submerged, HasTheGradientOfFiniteDifferences) {
  Random random(4);
  TriangleMesh mesh = box_mesh({-0.4, -0.6, -0.5}, {0.7, 0.5, 0.6});
  for (Vec3& v : mesh.vertices) v += random_vec(random, -0.1, 0.1);
  Moments q = Moments::Zero();
  q[S1] = 0.3, q[SX] = -0.8, q[SY] = 0.5;
  const double surface = 0.05, h = 1e-5;
  const std::vector<Vec3> gradient = submerged_gradient(mesh, surface, q);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = [&](double by) {
        TriangleMesh moved = mesh;
        moved.vertices[i][axis] += by;
        return q.dot(submerged(moved, surface));
      };
      // Second-order differences of a smooth function of size 1: h^2, and round-off over h.
      EXPECT_NEAR(gradient[i][axis], (value(h) - value(-h)) / (2 * h), 1e-8) << i << " " << axis;
    }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
