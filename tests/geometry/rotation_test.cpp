#include "geometry/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "body/test_meshes.hpp"
#include "error.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double round_off = 64 * 0x1p-52;  // nine entries, each of some six products of order one

TEST(AxisToZ, TurnsAnyAxisUp) {
  Random random(31);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 axis = random_vec(random, -3, 3);
    const Eigen::Matrix3d turn = axis_to_z(axis);
    EXPECT_LE((turn * axis.normalized() - Vec3::UnitZ()).norm(), round_off);
    EXPECT_LE((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm(), round_off);
    // By the smallest angle: what is across both stays.
    const Vec3 across = axis.cross(Vec3::UnitZ()).normalized();
    EXPECT_LE((turn * across - across).norm(), round_off);
  }
}

TEST(AxesAlong, AreRightHandedWithTheDirectionLast) {
  Random random(32);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 direction = random_vec(random, -1, 1).normalized();
    const Eigen::Matrix3d axes = axes_along(direction);
    EXPECT_EQ(Vec3(axes.row(2)), direction);
    EXPECT_LE((axes * axes.transpose() - Eigen::Matrix3d::Identity()).norm(), round_off);
    EXPECT_NEAR(axes.determinant(), 1, round_off);
  }
}

TEST(UniformNumbers, MakeUniformDirectionsAndRotations) {
  Random random(33);
  constexpr int draws = 20000;
  Vec3 mean = Vec3::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero(), turn = square;
  for (int i = 0; i < draws; ++i) {
    const Vec3 u = random_vec(random, 0, 1), d = uniform_direction(u[0], u[1]);
    const Eigen::Quaterniond q = uniform_rotation(u[0], u[1], u[2]);
    EXPECT_NEAR(d.norm(), 1, round_off);
    EXPECT_NEAR(q.norm(), 1, round_off);
    mean += d / draws;
    square += d * d.transpose() / draws;
    turn += q.toRotationMatrix() / draws;
  }
  // Means of numbers with a variance below one: five standard deviations.
  const double five = 5 / std::sqrt(draws);
  EXPECT_LE(mean.cwiseAbs().maxCoeff(), five);
  EXPECT_LE((square - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), five);
  EXPECT_LE(turn.cwiseAbs().maxCoeff(), five);
}

TEST(SphereDirections, AreSpreadEvenly) {
  for (const int n : {1, 2, 7, 500}) {
    const std::vector<Vec3> directions = sphere_directions(n);
    ASSERT_EQ(directions.size(), static_cast<std::size_t>(n));
    for (const Vec3& d : directions) EXPECT_NEAR(d.norm(), 1, 4 * 0x1p-52);
  }
  const std::vector<Vec3> many = sphere_directions(500);
  // The mean of a direction is zero, of its square 1/3 of one; the lattice misses both by some 1/n.
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Vec3 mean = Vec3::Zero();
  for (const Vec3& d : many) mean += d / 500, square += d * d.transpose() / 500;
  EXPECT_LE(mean.norm(), 2.0 / 500);
  EXPECT_LE((square - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), 2.0 / 500);
  // No two nearer than half the distance in a hexagonal packing, sqrt(8 pi / (sqrt(3) n)).
  for (std::size_t i = 0; i < many.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE((many[i] - many[j]).norm(), 0.5 * std::sqrt(8 * M_PI / (std::sqrt(3.0) * 500)));
  EXPECT_THROW((void)sphere_directions(0), InputError);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
