#include "solve/symmetric_indefinite.hpp"

#include <gtest/gtest.h>

#include <random>

namespace kreisel::core {
namespace THIS_FILE {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(int rows, int columns, std::mt19937& random) {
  // By hand: distributions of the standard library differ between implementations.
  return MatrixXd::NullaryExpr(rows, columns,
                               [&] { return static_cast<double>(random()) / 2147483648.0 - 1; });
}

MatrixXd random_symmetric(int n, std::mt19937& random) {
  const MatrixXd a = random_matrix(n, n, random);
  return a + a.transpose();
}

int negative_eigenvalues(const MatrixXd& a) {
  return static_cast<int>((Eigen::SelfAdjointEigenSolver<MatrixXd>(a).eigenvalues().array() < 0).count());
}

class SymmetricIndefiniteOf : public testing::TestWithParam<int> {};

TEST_P(SymmetricIndefiniteOf, SolvesWithTheInertiaOfTheEigenvalues) {
  std::mt19937 random(GetParam());
  for (int round = 0; round < 5; ++round) {
    const MatrixXd a = random_symmetric(GetParam(), random), want = random_matrix(GetParam(), 3, random);
    SymmetricIndefinite<> solver;
    ASSERT_TRUE(solver.factor(a));
    EXPECT_EQ(solver.negative(), negative_eigenvalues(a));
    MatrixXd x = a * want;
    solver.solve(x);
    // Backward stable: the relative error is that of the data, a few n u, times the condition.
    const auto singular = Eigen::JacobiSVD<MatrixXd>(a).singularValues();
    const double bound = 20 * GetParam() * 1.2e-16 * singular[0] / singular[GetParam() - 1];
    EXPECT_LE((x - want).norm(), bound * want.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, SymmetricIndefiniteOf, testing::Values(1, 2, 3, 4, 7, 24, 61));

TEST(SymmetricIndefinite, NeedsNoDiagonal) {
  MatrixXd a(4, 4);
  a << 0, 1, 0, 2,  //
      1, 0, 3, 0,   //
      0, 3, 0, 1,   //
      2, 0, 1, 0;
  SymmetricIndefinite<4> solver;
  ASSERT_TRUE(solver.factor(a));
  EXPECT_EQ(solver.negative(), 2);  // its eigenvalues come in pairs of either sign
  MatrixXd x = a * VectorXd::LinSpaced(4, 1, 4);
  solver.solve(x);
  EXPECT_LE((x - VectorXd::LinSpaced(4, 1, 4)).norm(), 1e-14);
}

TEST(SymmetricIndefinite, ReadsTheLowerTriangleAlone) {
  MatrixXd a(2, 2);
  a << 2, 1e30, 1, 3;
  SymmetricIndefinite<> solver;
  ASSERT_TRUE(solver.factor(a));
  MatrixXd x = VectorXd::Constant(2, 5);
  solver.solve(x);
  EXPECT_LE((x - Eigen::Vector2d(2, 1)).norm(), 1e-15);
}

TEST(SymmetricIndefinite, IsNotMisledByUnits) {
  std::mt19937 random(3);
  const MatrixXd plain = random_symmetric(6, random);
  VectorXd units(6);
  units << 1e-12, 1e9, 1, 1e-3, 1e15, 1e4;
  const MatrixXd a = units.asDiagonal() * plain * units.asDiagonal();
  SymmetricIndefinite<> solver;
  ASSERT_TRUE(solver.factor(a));
  EXPECT_EQ(solver.negative(), negative_eigenvalues(plain));
}

TEST(SymmetricIndefinite, SaysThatAMatrixIsSingular) {
  std::mt19937 random(4);
  for (int rank : {0, 1, 3, 5}) {
    const MatrixXd f = random_matrix(6, rank, random);
    MatrixXd a = MatrixXd::Zero(6, 6);
    if (rank > 0) a = f * random_symmetric(rank, random) * f.transpose();
    SymmetricIndefinite<> solver;
    EXPECT_FALSE(solver.factor(a)) << "rank " << rank;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
