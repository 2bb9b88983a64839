#include "solve/arrow.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>
#include <random>

namespace kreisel::core {
namespace THIS_FILE {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Entries of a symmetric matrix, as a caller of Arrow has them.
struct Triplets {
  int size = 0;
  std::vector<int> rows, columns;
  std::vector<double> values;

  void add(int row, int column, double value) {
    rows.push_back(row);
    columns.push_back(column);
    values.push_back(value);
  }
  [[nodiscard]] Pattern pattern() const { return {size, 0, rows, columns}; }
  [[nodiscard]] MatrixXd dense() const {
    MatrixXd a = MatrixXd::Zero(size, size);
    for (std::size_t e = 0; e < rows.size(); ++e) {
      a(rows[e], columns[e]) += values[e];
      if (rows[e] != columns[e]) a(columns[e], rows[e]) += values[e];
    }
    return a;
  }
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  /// In [-1, 1), never near 0.
  double operator()() {
    const double x = static_cast<double>(engine_()) / 2147483648.0 - 1;
    return x + (x < 0 ? -0.1 : 0.1);
  }

 private:
  std::mt19937 engine_;
};

/// A barrier's system: `free` variables with diagonals of both signs, `rays` pairs of variables with a
/// constraint between them and its slack, and `dense` rows of constraints, with no diagonal, over all of
/// them.
Triplets barrier_system(int free, int rays, int dense, unsigned seed) {
  Random random(seed);
  Triplets t;
  const int variables = free + 2 * rays;
  t.size = variables + 2 * rays + dense;
  for (int i = 0; i < variables; ++i) t.add(i, i, 3 * random());
  for (int i = 0; i < variables; ++i) t.add(i, i, random());  // as a sum: the Hessian and the barrier
  for (int r = 0; r < rays; ++r) {
    const int z0 = free + 2 * r, slack = variables + r, row = variables + rays + r;
    t.add(row, z0, -1), t.add(row, z0 + 1, 1), t.add(row, slack, -1);
    t.add(slack, slack, std::abs(random()));
  }
  for (int d = 0; d < dense; ++d)
    for (int i = 0; i < variables; ++i) t.add(variables + 2 * rays + d, i, random());
  return t;
}

VectorXd solved(const Arrow& arrow, VectorXd x) {
  arrow.solve({x.data(), static_cast<std::size_t>(x.size())});
  return x;
}

void expect_solves(const Triplets& t, std::size_t delayed = 0) {
  const auto arrow = Arrow::of(t.pattern());
  ASSERT_TRUE(arrow);
  ASSERT_TRUE(arrow->factor(t.values));
  EXPECT_EQ(arrow->delayed(), delayed);
  const MatrixXd a = t.dense();
  const auto eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(a).eigenvalues();
  EXPECT_EQ(arrow->negative(), (eigenvalues.array() < 0).count());
  const VectorXd want = VectorXd::LinSpaced(t.size, -1, 2);
  const VectorXd x = solved(*arrow, a * want);
  // The residual is refined to round-off, so the error is that times the condition.
  const double condition = eigenvalues.cwiseAbs().maxCoeff() / eigenvalues.cwiseAbs().minCoeff();
  EXPECT_LE((x - want).norm(), 1e-13 * condition * want.norm()) << "condition " << condition;
}

TEST(Arrow, SolvesADiagonalWithDenseRows) { expect_solves(barrier_system(200, 0, 4, 1)); }
TEST(Arrow, SolvesBlocksOfRaysWhoseEndsAreOrdered) { expect_solves(barrier_system(0, 60, 10, 2)); }
TEST(Arrow, SolvesSinglesAndBlocksTogether) { expect_solves(barrier_system(50, 40, 6, 3)); }
TEST(Arrow, SolvesADiagonal) { expect_solves(barrier_system(7, 0, 0, 4)); }
/// So few variables are in the border themselves, and the rows before it, without a diagonal.
TEST(Arrow, SolvesWhatIsNearlyAllBorder) { expect_solves(barrier_system(9, 0, 6, 5), 6); }

TEST(Arrow, TakesIndicesFromOneInEitherTriangle) {
  Triplets t = barrier_system(40, 5, 3, 6);
  const MatrixXd a = t.dense();
  for (std::size_t e = 0; e < t.rows.size(); ++e) {
    ++t.rows[e], ++t.columns[e];
    if (e % 2) std::swap(t.rows[e], t.columns[e]);
  }
  const auto arrow = Arrow::of({t.size, 1, t.rows, t.columns});
  ASSERT_TRUE(arrow && arrow->factor(t.values));
  const VectorXd want = VectorXd::LinSpaced(t.size, 1, 2);
  EXPECT_LE((solved(*arrow, a * want) - want).norm(), 1e-10);
}

TEST(Arrow, DelaysPivotsThatAreZeroOrSmall) {
  Triplets t = barrier_system(100, 0, 5, 7);
  for (const int i : {3, 40, 77})
    t.values[static_cast<std::size_t>(i)] = t.values[100 + static_cast<std::size_t>(i)] = 0;
  t.values[50] = 1e-13, t.values[150] = 0;
  expect_solves(t, 4);
}

TEST(Arrow, KeepsItsDigitsWherePivotsDifferByTwentyOrders) {
  // As at the end of an interior-point solve: some variables free, most at a bound.
  Triplets t = barrier_system(300, 0, 4, 8);
  Random random(9);
  for (std::size_t i = 0; i < 300; ++i) {
    t.values[i] = std::pow(10.0, i < 6 ? -10.0 : 10 * std::abs(random()));
    t.values[300 + i] = 0;
  }
  const auto arrow = Arrow::of(t.pattern());
  ASSERT_TRUE(arrow && arrow->factor(t.values));
  EXPECT_EQ(arrow->negative(), 4);  // positive definite on the variables: as many as there are rows
  const VectorXd want = VectorXd::Ones(t.size), right = t.dense() * want;
  const VectorXd residual = t.dense() * solved(*arrow, right) - right;
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    EXPECT_LE(std::abs(residual[i]), 1e-12 * t.dense().row(i).cwiseAbs().sum()) << "row " << i;
}

TEST(Arrow, SaysThatDependentRowsAreSingularAndThatAPerturbationMendsIt) {
  Triplets t = barrier_system(80, 0, 4, 10);
  const std::size_t last = t.values.size() - 80;
  for (std::size_t i = 0; i < 80; ++i) t.values[last + i] = t.values[last - 80 + i];  // a constraint twice
  const auto same = t.values;
  for (int d = 0; d < 4; ++d) t.add(80 + d, 80 + d, 0);  // where a solver perturbs
  const auto arrow = Arrow::of(t.pattern());
  ASSERT_TRUE(arrow);
  EXPECT_FALSE(arrow->factor(t.values));
  for (std::size_t d = 0; d < 4; ++d) t.values[same.size() + d] = -1e-8;
  ASSERT_TRUE(arrow->factor(t.values));
  const auto eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(t.dense()).eigenvalues();
  EXPECT_EQ(arrow->negative(), (eigenvalues.array() < 0).count());
}

TEST(Arrow, DoesNotDependOnTheNumberOfThreads) {
  // Above the size from which threads share the work; sums are joined in the order of the chunks.
  const Triplets t = barrier_system(60'000, 0, 6, 11);
  const auto arrow = Arrow::of(t.pattern());
  ASSERT_TRUE(arrow && arrow->factor(t.values));
  const VectorXd right = VectorXd::LinSpaced(t.size, 0, 1), first = solved(*arrow, right);
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(arrow->factor(t.values));
    EXPECT_EQ(solved(*arrow, right), first);
  }
}

TEST(ArrowShape, PutsDenseRowsIntoTheBorder) {
  const Triplets t = barrier_system(100, 20, 3, 12);
  const auto shape = ArrowShape::of(t.pattern());
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->border, (std::vector<int>{180, 181, 182}));
  EXPECT_EQ(shape->blocks[0].size(), 100u);
  EXPECT_TRUE(shape->blocks[1].empty() && shape->blocks[2].empty());
  ASSERT_EQ(shape->blocks[3].size(), 20u * 4);
  EXPECT_EQ(std::vector(shape->blocks[3].begin(), shape->blocks[3].begin() + 4),
            (std::vector<int>{100, 101, 140, 160}));
}

TEST(ArrowShape, IsNotThatOfALaplacian) {
  for (const int side : {12, 30}) {  // cells of a cube tied to their neighbours, and four dense rows
    Triplets t;
    const int cells = side * side * side;
    t.size = cells + 4;
    const auto cell = [&](int x, int y, int z) { return (z * side + y) * side + x; };
    for (int i = 0; i < cells; ++i) t.add(i, i, 6);
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x + 1 < side; ++x) {
          t.add(cell(x + 1, y, z), cell(x, y, z), -1);
          t.add(cell(y, x + 1, z), cell(y, x, z), -1);
          t.add(cell(y, z, x + 1), cell(y, z, x), -1);
        }
    for (int d = 0; d < 4; ++d)
      for (int i = 0; i < cells; ++i) t.add(cells + d, i, 1);
    EXPECT_FALSE(ArrowShape::of(t.pattern())) << side;
    EXPECT_EQ(Arrow::of(t.pattern()), nullptr);
  }
}

TEST(ArrowShape, OfNothingIsEmpty) {
  const auto shape = ArrowShape::of({});
  ASSERT_TRUE(shape);
  EXPECT_TRUE(shape->border.empty());
  for (const auto& blocks : shape->blocks) EXPECT_TRUE(blocks.empty());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
