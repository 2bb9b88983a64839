#include "offset/offset_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "body/models/geodesic.hpp"
#include "body/test_meshes.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/components.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Closed, oriented, outward.
void expect_outward(const TriangleMesh& mesh) {
  for (const Shell& shell : shells(mesh)) {
    EXPECT_TRUE(shell.closed);
    EXPECT_TRUE(shell.oriented);
    EXPECT_GT(shell.volume, 0);
  }
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Shell& shell : shells(mesh)) sum += shell.volume;
  return sum;
}

class OffsetBy : public testing::TestWithParam<double> {
 protected:
  static constexpr double voxel = 0.05;
};
INSTANTIATE_TEST_SUITE_P(Distances, OffsetBy, testing::Values(-0.9, -0.5, -0.23, 0.3, 0.77));

TEST_P(OffsetBy, ASphereIsASphereToWithinAVoxel) {
  const double radius = 1 + GetParam();
  const TriangleMesh offset = offset_surface(geodesic_sphere(24), GetParam(), voxel);
  expect_outward(offset);
  ASSERT_EQ(shells(offset).size(), 1u);
  for (const Vec3& v : offset.vertices) EXPECT_NEAR(v.norm(), radius, voxel);
  const double ball = 4 * std::numbers::pi / 3;
  EXPECT_LT(volume(offset), ball * std::pow(radius + voxel, 3));
  EXPECT_GT(volume(offset), ball * std::pow(radius - voxel, 3));
}

/// Inward a smaller cube; outward the cube with round edges.
double distance_to_cube(const Vec3& p) {
  const Vec3 beyond = p.cwiseAbs() - Vec3::Ones();
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

TEST_P(OffsetBy, ACubeHasTheDistanceEverywhereToWithinAVoxel) {
  const double d = GetParam();
  const TriangleMesh offset = offset_surface(box_mesh(Vec3::Constant(-1), Vec3::Ones()), d, voxel);
  expect_outward(offset);
  for (const Vec3& v : offset.vertices) EXPECT_NEAR(distance_to_cube(v), d, voxel);
  const Box box = bounding_box(offset);
  EXPECT_LT((box.hi - Vec3::Constant(1 + d)).cwiseAbs().maxCoeff(), voxel);
  EXPECT_LT((box.lo + Vec3::Constant(1 + d)).cwiseAbs().maxCoeff(), voxel);
  // A cube, three pairs of slabs, twelve quarters of cylinders, eight eighths of a ball; sharp edges lose
  // less than a voxel across.
  const double a = 2, r = std::max(d, 0.0), side = a + 2 * std::min(d, 0.0);
  const double want = d < 0 ? side * side * side
                            : a * a * a + 6 * a * a * r + 3 * std::numbers::pi * a * r * r +
                                  4 * std::numbers::pi / 3 * r * r * r;
  EXPECT_NEAR(volume(offset), want, 12 * side * voxel * voxel);
}

TEST(OffsetSurface, FollowsTheMeshWhereverItIs) {
  const Vec3 shift(1000, -50, 3);
  const TriangleMesh mesh = moved(geodesic_sphere(12), Eigen::Matrix3d::Identity(), shift);
  for (const Vec3& v : offset_surface(mesh, -0.4, 0.1).vertices) EXPECT_NEAR((v - shift).norm(), 0.6, 0.1);
}

TEST(OffsetSurface, TakesWhatAMeshEnclosesForSolid) {
  TriangleMesh cavity = inverted(geodesic_sphere(12));
  for (Vec3& v : cavity.vertices) v *= 0.4;
  const TriangleMesh offset = offset_surface(both(geodesic_sphere(12), cavity), -0.2, 0.05);
  ASSERT_EQ(shells(offset).size(), 1u);
  for (const Vec3& v : offset.vertices) EXPECT_NEAR(v.norm(), 0.8, 0.05);
}

TEST(OffsetSurface, IsEmptyWhereNothingIsThatDeep) {
  EXPECT_TRUE(offset_surface(geodesic_sphere(12), -1.2, 0.1).triangles.empty());
  // Two walls of 1 in the shape of a T, whose box is a cube of 4.
  const TriangleMesh walls = both(box_mesh({0, 0, 0}, {4, 1, 4}), box_mesh({1.5, 1.001, 0}, {2.5, 4, 4}));
  EXPECT_FALSE(offset_surface(walls, -0.4, 0.1).triangles.empty());
  EXPECT_TRUE(offset_surface(walls, -0.9, 0.1).triangles.empty());
}

TEST(OffsetSurface, RefusesWhatIsNoOffset) {
  const TriangleMesh box = box_mesh(Vec3::Constant(-1), Vec3::Ones());
  const auto offset = [&](double distance, double voxel) { (void)offset_surface(box, distance, voxel); };
  expect_refusal([&] { offset(0, 0.1); }, "offset by 0 in voxels of 0.1", {"a distance that is not 0"});
  expect_refusal([&] { offset(std::numeric_limits<double>::quiet_NaN(), 0.1); }, "offset by nan", {});
  expect_refusal([&] { offset(0.1, -1); }, "offset by 0.1 in voxels of -1", {"an edge > 0"});
  expect_refusal([&] { offset(-0.1, 1e-5); }, "offset by -0.1 in voxels of 1e-05",
                 {"takes 200000 of them along a side", "at most 2048"});
  expect_refusal([] { (void)offset_surface({}, 1, 1); }, "offset of a mesh without triangles", {});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
