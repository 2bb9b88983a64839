#include "deform/biharmonic_weights.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "body/test_meshes.hpp"
#include "deform/bodies.hpp"
#include "deform/bounded_quadratic.hpp"
#include "device/scoped_environment.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(BoundedMinimum, MeetsTheOptimalityConditions) {
  // A chain of springs that is held at 1 in the middle and may not go below 0.2 nor, at one end, above 0.3.
  const Eigen::Index n = 41;
  const QuadraticForm Q = [&](const Eigen::VectorXd& x, Eigen::VectorXd& out) {
    out = 0.1 * x;
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      out[i] += x[i] - x[i + 1];
      out[i + 1] += x[i + 1] - x[i];
    }
  };
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(n, 2.1), lower = Eigen::VectorXd::Constant(n, 0.2),
                  upper = Eigen::VectorXd::Ones(n);
  diagonal[0] = diagonal[n - 1] = 1.1;
  lower[20] = 1;
  upper[23] = 0.3;
  const BoundedMinimum found = bounded_minimum(Q, diagonal, lower, upper, lower);
  EXPECT_LT(found.residual, 1e-7);
  Eigen::VectorXd slope(n);
  Q(found.x, slope);
  int at_bound = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (lower[i] == upper[i]) continue;
    EXPECT_GE(found.x[i], lower[i]);
    EXPECT_LE(found.x[i], upper[i]);
    if (found.x[i] == lower[i]) {
      ++at_bound;
      EXPECT_GE(slope[i], -1e-6);
    } else if (found.x[i] == upper[i]) {
      EXPECT_LE(slope[i], 1e-6);
    } else {
      EXPECT_NEAR(slope[i], 0, 1e-6);
    }
  }
  EXPECT_GT(at_bound, 5);
}

TEST(Cage, HasTheCellsThatMeetTheSolidAndTheirOuterCorners) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {4, 2, 1});
  const CageGrid grid = centred_cage_grid(box, 2, 4);
  const Cage cage(box, grid);
  EXPECT_EQ(grid.cells, (std::array{4, 2, 1}));
  EXPECT_EQ(cage.cells().size(), 8u * 64u);
  EXPECT_EQ(cage.nodes().size(), 17u * 9u * 5u);
  EXPECT_EQ(cage.handles().size(), 5u * 3u * 2u);
  // A point outside is moved to the nearest inside.
  const Cage::Inside beside = cage.inside({4.5, 1.1, -3});
  EXPECT_EQ(beside.cell, (Cage::Place{15, 4, 0}));
  EXPECT_NEAR((beside.at - Vec3(1, 0.4, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(beside.moved, (std::array{true, false, true}));
  // Of a bar across the diagonal only what it meets.
  TriangleMesh bar = leaning_ellipsoid({1, 1, 8}, 45, 40);
  const Cage slender(bar, centred_cage_grid(bar, 3, 5));
  EXPECT_LT(slender.cells().size(), 50u * 64u);
  for (const Vec3& v : bar.vertices) {
    const auto moved = slender.inside(v).moved;
    EXPECT_FALSE(moved[0] || moved[1] || moved[2]);
  }
}

TEST(BiharmonicWeights, AreAPartitionOfUnityWithinBounds) {
  const TriangleMesh bar = leaning_ellipsoid({3, 4, 8}, 30, 40);
  const TemporaryFolder folder;
  const ScopedEnvironment cache("KREISEL_CACHE_DIR", folder.path.string());
  const Cage cage(bar, centred_cage_grid(bar, 2, 4));
  const BiharmonicWeights made = biharmonic_weights(cage);
  EXPECT_LT(made.residual, 1e-6);
  const Eigen::VectorXd sums = made.weights * Eigen::VectorXd::Ones(made.weights.cols());
  EXPECT_LT((sums.array() - 1).abs().maxCoeff(), 1e-8);
  for (Eigen::Index k = 0; k < made.weights.nonZeros(); ++k) {
    EXPECT_GE(made.weights.valuePtr()[k], 0.0);
    EXPECT_LE(made.weights.valuePtr()[k], 1 + 1e-8);
  }
  for (std::size_t j = 0; j < cage.handles().size(); ++j)
    EXPECT_NEAR(made.weights.coeff(cage.handles()[j], static_cast<Eigen::Index>(j)), 1, 1e-12);
  EXPECT_GT(made.seconds, 0.0);
  const BiharmonicWeights again = biharmonic_weights(cage);
  EXPECT_EQ(again.seconds, 0.0);
  EXPECT_EQ((again.weights - made.weights).norm(), 0.0);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
