#include "deform/nearest_point.hpp"

#include <gtest/gtest.h>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double dear = 1e6;

TEST(NearestPoint, WithoutRowsIsTheCentreLessTheSlope) {
  const Eigen::MatrixXd energy = Eigen::Vector2d(2, 4).asDiagonal();
  Eigen::MatrixX3d centre(2, 3), slope(2, 3);
  centre << 1, 2, 3, 4, 5, 6;
  slope << 2, 0, 0, 0, 4, 0;
  Eigen::MatrixX3d want = centre;
  want(0, 0) -= 1;
  want(1, 1) -= 1;
  EXPECT_LT((nearest_point(energy, centre, slope, {}, dear) - want).norm(), 1e-14);
}

TEST(NearestPoint, OfOneHandleOnAPlaneHasAClosedForm) {
  // The nearest point to the origin with n . u >= 2, |n| = 1, is 2 n.
  const Eigen::RowVector3d n = Eigen::RowVector3d(1, 2, -2) / 3;
  HandleRows rows;
  rows.add(-n, -2);
  const Eigen::MatrixX3d nil = Eigen::MatrixX3d::Zero(1, 3);
  const Eigen::MatrixXd energy = Eigen::MatrixXd::Identity(1, 1);
  EXPECT_LT((nearest_point(energy, nil, nil, rows, dear) - 2 * n).norm(), 1e-8);
}

TEST(NearestPoint, MeetsTheConditionsOfAnOptimum) {
  Random random(17);
  const Eigen::Index handles = 6;
  Eigen::MatrixXd root =
      Eigen::MatrixXd::NullaryExpr(handles, handles, [&] { return uniform(random, -1, 1); });
  const Eigen::MatrixXd energy = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(handles, handles);
  HandleRows rows;
  for (int r = 0; r < 9; ++r) {
    const Eigen::MatrixX3d a =
        Eigen::MatrixX3d::NullaryExpr(handles, 3, [&] { return uniform(random, -1, 1); });
    rows.add(a, uniform(random, -1, 0.5));
  }
  const Eigen::MatrixX3d nil = Eigen::MatrixX3d::Zero(handles, 3);
  const Eigen::MatrixX3d u = nearest_point(energy, nil, nil, rows, dear);
  const Eigen::VectorXd slack = rows.bounds() - rows.columns().transpose() * u.reshaped();
  EXPECT_GT(slack.minCoeff(), -1e-6);
  // energy u = - active rows^T lambda with lambda >= 0: no direction along which all active rows stay met
  // lowers it.
  int looked_along = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const Eigen::MatrixX3d d =
        Eigen::MatrixX3d::NullaryExpr(handles, 3, [&] { return uniform(random, -1, 1); });
    const Eigen::VectorXd along = rows.columns().transpose() * d.reshaped();
    bool stays = true;
    for (Eigen::Index r = 0; r < rows.size(); ++r) stays = stays && (slack[r] > 1e-5 || along[r] <= 0);
    if (!stays) continue;
    ++looked_along;
    EXPECT_GT((energy * u).cwiseProduct(d).sum(), -1e-5);
  }
  EXPECT_GT(looked_along, 20);
}

TEST(NearestPoint, OfRowsThatContradictEachOtherIsBetweenThem) {
  HandleRows rows;
  rows.add(Eigen::RowVector3d(1, 0, 0), -1);   // x <= -1
  rows.add(Eigen::RowVector3d(-1, 0, 0), -1);  // x >= 1
  const Eigen::MatrixX3d nil = Eigen::MatrixX3d::Zero(1, 3);
  const Eigen::MatrixX3d u = nearest_point(Eigen::MatrixXd::Identity(1, 1), nil, nil, rows, 10);
  EXPECT_NEAR(u(0, 0), 0, 1e-6);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
