#include "body/moments.hpp"

#include <gtest/gtest.h>

#include "body/mesh_moments.hpp"
#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Every formula here is a few dozen operations on numbers no larger than the largest: 64 roundings.
void expect_same(const Moments& got, const Moments& want) {
  const double tolerance = 64 * 0x1p-53 * want.cwiseAbs().maxCoeff();
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(got[k], want[k], tolerance) << moment_names[k];
}

TEST(Moments, OfABoxAtTheOriginHaveTheKnownClosedForm) {
  Moments want;
  want << 24, 0, 0, 0, 0, 0, 0, 24 * 4 / 12.0, 24 * 9 / 12.0, 24 * 16 / 12.0;
  expect_same(box_moments(Vec3::Zero(), {2, 3, 4}), want);
}

TEST(Moments, OfABoxFromCornerToCornerAreProductsOfOneDimensionalIntegrals) {
  const Vec3 lo(-0.5, 1.25, -3), hi(2, 1.5, 0.75);
  const auto power = [&](int axis, int p) {
    return (std::pow(hi[axis], p + 1) - std::pow(lo[axis], p + 1)) / (p + 1);
  };
  const auto integral = [&](int x, int y, int z) { return power(0, x) * power(1, y) * power(2, z); };
  Moments want;
  want << integral(0, 0, 0), integral(1, 0, 0), integral(0, 1, 0), integral(0, 0, 1), integral(1, 1, 0),
      integral(0, 1, 1), integral(1, 0, 1), integral(2, 0, 0), integral(0, 2, 0), integral(0, 0, 2);
  expect_same(box_moments((lo + hi) / 2, hi - lo), want);
}

TEST(Moments, OfATranslatedBoxAreTheTransformedOnes) {
  const Vec3 edges(1, 2, 0.5), centre(0.25, -1, 2), shift(3, -0.75, 1.5);
  expect_same(transformed(box_moments(centre, edges), Eigen::Matrix3d::Identity(), shift),
              box_moments(centre + shift, edges));
}

TEST(Moments, OfABoxTurnedByARightAngleAreThoseOfTheSwappedBox) {
  Eigen::Matrix3d turn;  // x -> y, y -> -x
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  expect_same(transformed(box_moments({0.25, -1, 2}, {1, 2, 0.5}), turn, {1, 2, 3}),
              box_moments(Vec3(2, 2.25, 5), {2, 1, 0.5}));
}

TEST(Moments, OfAMirroredBoxAreThoseOfTheBoxOnTheOtherSide) {
  const Eigen::Matrix3d mirror = Vec3(-1, 1, 1).asDiagonal();
  expect_same(transformed(box_moments({0.25, -1, 2}, {1, 2, 0.5}), mirror, Vec3::Zero()),
              box_moments({-0.25, -1, 2}, {1, 2, 0.5}));
}

TEST(Moments, AgreeWithAMeshThatIsTurnedItself) {
  Random random(3);
  const TriangleMesh mesh = tetrahedron_mesh({0.1, 0, -0.2}, {2, 0.3, 0}, {0.2, 1.5, 0.1}, {0.4, 0.2, 1.1});
  const Moments still = reference::mesh_moments(mesh).value;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Matrix3d rotation = random_rotation(random);
    const Vec3 shift = random_vec(random, -2, 2);
    const auto want = reference::mesh_moments(moved(mesh, rotation, shift));
    const Moments got = transformed(still, rotation, shift);
    // Four triangles, a few dozen roundings each, of terms that cancel: measured by the absolute sums.
    for (int k = 0; k < 10; ++k)
      EXPECT_NEAR(got[k], want.value[k], 64 * 0x1p-53 * want.abs_sum.maxCoeff())
          << moment_names[k] << ", trial " << trial;
  }
}

TEST(Moments, ThereAndBackIsTheIdentity) {
  Random random(4);
  const Moments s = box_moments({0.3, 0.2, -0.1}, {1, 0.5, 0.25});
  const Eigen::Matrix3d rotation = random_rotation(random);
  const Vec3 shift(0.5, -0.25, 1);
  expect_same(
      transformed(transformed(s, rotation, shift), rotation.transpose(), -(rotation.transpose() * shift)), s);
}

TEST(Moments, OfAScaledBoxAreTheScaledOnes) {
  expect_same(scaled(box_moments({0.25, -1, 2}, {1, 2, 0.5}), 3, 0.75),
              0.75 * box_moments({0.75, -3, 6}, {3, 6, 1.5}));
}

TEST(Moments, CentreOfMassOfABoxIsItsCentre) {
  const Vec3 centre(0.25, -1, 2);
  EXPECT_LE((centre_of_mass(7 * box_moments(centre, {1, 2, 0.5})) - centre).norm(), 8 * 0x1p-53 * 2);
}

TEST(Moments, InertiaAboutTheCentreIsThatOfABoxWhereverItStands) {
  const Vec3 edges(1, 2, 0.5), squared = edges.cwiseAbs2();
  const double mass = edges.prod();
  const Eigen::Matrix3d want =
      (mass / 12 * Vec3(squared[1] + squared[2], squared[0] + squared[2], squared[0] + squared[1]))
          .asDiagonal();
  for (const Vec3& centre : {Vec3(0, 0, 0), Vec3(0.25, -1, 2), Vec3(-3, 0, 1)}) {
    const Moments s = box_moments(centre, edges);
    // The parallel axis theorem takes away numbers as large as the moments.
    const double tolerance = 16 * 0x1p-53 * s.cwiseAbs().maxCoeff();
    EXPECT_LE((inertia_about_centre(s) - want).cwiseAbs().maxCoeff(), tolerance);
    const Eigen::Matrix3d steiner =
        mass * (centre.squaredNorm() * Eigen::Matrix3d::Identity() - centre * centre.transpose());
    EXPECT_LE((inertia(s) - want - steiner).cwiseAbs().maxCoeff(), tolerance);
  }
}

TEST(Moments, InertiaOfATurnedBoxTurnsWithIt) {
  Random random(5);
  const Eigen::Matrix3d rotation = random_rotation(random);
  const Moments s = box_moments(Vec3::Zero(), {1, 2, 0.5});
  const Eigen::Matrix3d got = inertia_about_centre(transformed(s, rotation, {1, -1, 0.5}));
  const Eigen::Matrix3d want = rotation * inertia(s) * rotation.transpose();
  EXPECT_LE((got - want).cwiseAbs().maxCoeff(), 64 * 0x1p-53 * 3);
}

TEST(PrincipalAxes, OfATurnedBoxAreItsEdges) {
  // A cuboid of edges 1, 2, 3: m / 12 (b^2 + c^2) about each, the longest edge with the smallest moment.
  const Moments box = box_moments(Vec3(1, 2, 3), {1, 2, 3});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.25, Vec3(1, 0, 0)).toRotationMatrix();
  const PrincipalAxes principal(inertia_about_centre(transformed(box, turn, Vec3(-1, 4, 2))));
  EXPECT_LE((principal.moments - Eigen::Vector3d(2.5, 5, 6.5)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(principal.nearest_to_z(), 0) << "the longest edge, the least moment";
  EXPECT_NEAR(std::abs(principal.axes.col(0).dot(turn.col(2))), 1, 1e-12);
  EXPECT_NEAR(principal.tilt_degrees(), 0.25 * 180 / M_PI, 1e-10);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
