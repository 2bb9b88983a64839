#include "body/mesh_moments_gradient.hpp"

#include <gtest/gtest.h>

#include "body/mesh_moments.hpp"
#include "body/test_meshes.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Moments random_q(Random& random) {
  Moments q;
  for (double& c : q) c = uniform(random, -1, 1);
  return q;
}

class MeshMomentsGradientOn : public testing::TestWithParam<bool> {
 protected:
  device::Device& device() { return GetParam() ? single_device() : test_device(); }
};

TEST_P(MeshMomentsGradientOn, StaysWithinTheBoundOfTheReference) {
  Random random(5);
  for (const std::size_t n : {1u, 2u, 63u, 64u, 65u, 997u, 7919u}) {
    SCOPED_TRACE(n);
    TriangleMesh soup = triangle_soup(n, 200 + n);
    const Vec3 middle = bounding_box(soup).centre();
    for (Vec3& v : soup.vertices) v -= middle;
    const Moments q = random_q(random);
    const auto want = reference::mesh_moments_gradient(soup, q);
    const std::vector<Vec3> got = mesh_moments_gradient(soup, q, device());
    const double bound = mesh_moments_gradient_bound(soup, device());
    ASSERT_EQ(got.size(), soup.vertices.size());
    for (std::size_t i = 0; i < got.size(); ++i)
      EXPECT_LE((got[i] - want.value[i]).norm(), bound * want.abs_sum[i]) << "vertex " << i;
  }
}

TEST_P(MeshMomentsGradientOn, OfAMeshAnywhereIsThatOfItsQuadricThere) {
  const TriangleMesh box = box_mesh({3, -2, 5}, {4, 0, 5.5});
  Random random(6);
  const Moments q = random_q(random);
  const auto want = reference::mesh_moments_gradient(box, q);
  const std::vector<Vec3> got = mesh_moments_gradient(box, q, device());
  // Moved to the middle and back, what cancels is as large as the place is far.
  const double bound = 8 * mesh_moments_gradient_bound(box, device());
  for (std::size_t i = 0; i < got.size(); ++i)
    EXPECT_LE((got[i] - want.value[i]).norm(), bound * want.abs_sum[i]) << "vertex " << i;
}

TEST_P(MeshMomentsGradientOn, OfAnEmptyMeshIsZero) {
  const std::vector<Vec3> got = mesh_moments_gradient({{Vec3(1, 2, 3)}, {}}, Moments::Ones(), device());
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0], Vec3(Vec3::Zero()));
}

INSTANTIATE_TEST_SUITE_P(Precisions, MeshMomentsGradientOn, testing::Bool());

TEST(MeshMomentsGradient, IsTheOneOfFiniteDifferences) {
  Random random(7);
  TriangleMesh mesh = box_mesh({-0.4, -0.6, -0.5}, {0.7, 0.5, 0.6});
  for (Vec3& v : mesh.vertices) v += random_vec(random, -0.1, 0.1);
  const Moments q = random_q(random);
  const auto gradient = reference::mesh_moments_gradient(mesh, q).value;
  // q . s is a polynomial of each coordinate of degree three: the error is h^2 / 6 times its third
  // derivative.
  const double h = 1e-4;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = [&](double by) {
        TriangleMesh moved = mesh;
        moved.vertices[i][axis] += by;
        return q.dot(reference::mesh_moments(moved).value);
      };
      EXPECT_NEAR(gradient[i][axis], (value(h) - value(-h)) / (2 * h), 1e-8) << i << " " << axis;
    }
}

TEST(MeshMomentsGradient, AlongAGrowthOfAllIsTheDegreeTimesTheMoment) {
  const TriangleMesh mesh = box_mesh({-1, -2, -0.5}, {2, 1, 3});
  const Moments s = reference::mesh_moments(mesh).value;
  for (int k = 0; k < 10; ++k) {
    const auto gradient = reference::mesh_moments_gradient(mesh, Moments::Unit(k)).value;
    double along = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i) along += gradient[i].dot(mesh.vertices[i]);
    const double degree = k == S1 ? 3 : k <= SZ ? 4 : 5;  // Euler: moments are homogeneous
    EXPECT_NEAR(along, degree * s[k], 1e-12 * std::abs(degree * s[k]) + 1e-12) << moment_names[k];
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
