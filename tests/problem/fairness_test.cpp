#include "problem/fairness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

ConvexHull box_hull(const Vec3& half) { return convex_hull(box_mesh(-half, half).vertices); }

/// A cube whose top falls off to one side: its faces are unlike each other, and all of them stable.
ConvexHull wedge_hull() {
  TriangleMesh wedge = box_mesh({0, 0, 0}, {1, 1, 1});
  for (Vec3& v : wedge.vertices)
    if (v[2] > 0.5 && v[0] > 0.5) v[2] = 0.75;
  return convex_hull(wedge.vertices);
}

TEST(Fairness, OfACubesMiddleIsPerfect) {
  const Fairness cube(box_hull({0.5, 0.5, 0.5}), Vec3::Zero());
  EXPECT_NEAR(cube.loss(Vec3::Zero()), 0, 1e-14);
  EXPECT_NEAR(cube.gradient(Vec3::Zero()).norm(), 0, 1e-12);
  EXPECT_NEAR(cube.fairest().norm(), 0, 1e-7);
}

TEST(Fairness, OfABoxIsTheMeanWaitOfItsSolidAngles) {
  const Vec3 half(0.4, 0.5, 0.6);
  const Fairness box(box_hull(half), Vec3::Zero());
  double waits = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = half[k], a = half[(k + 1) % 3], b = half[(k + 2) % 3];
    waits += 2 * std::numbers::pi / std::atan(a * b / (d * half.norm()));
  }
  EXPECT_NEAR(box.loss(Vec3::Zero()), waits / 36 - 1, 1e-12);
}

TEST(Fairness, DoesNotGiveUpOneSmallFaceForTheOther) {
  // A sum of squares would: of a bar's ends one would come up in 19 % of all throws, the other in 3.
  const Fairness bar(box_hull({1, 0.7, 0.5}), {0.1, 0.05, 0.02});
  EXPECT_NEAR(bar.fairest().norm(), 0, 1e-5);
}

TEST(Fairness, GradientMatchesCentralDifferences) {
  Random random(61);
  const Fairness wedge(wedge_hull(), {0.47, 0.5, 0.44});
  for (int trial = 0; trial < 10; ++trial) {
    const Vec3 at = Vec3(0.47, 0.5, 0.44) + random_vec(random, -0.08, 0.08);
    const Vec3 gradient = wedge.gradient(at);
    constexpr double step = 1e-5;  // cut off: 1e-10 times a third derivative of some hundred
    for (int k = 0; k < 3; ++k) {
      const Vec3 d = step * Vec3::Unit(k);
      EXPECT_NEAR(gradient[k], (wedge.loss(at + d) - wedge.loss(at - d)) / (2 * step), 1e-7);
    }
  }
}

TEST(Fairness, IsLeastAtTheFairest) {
  Random random(62);
  const Fairness wedge(wedge_hull(), {0.47, 0.5, 0.44});
  const Vec3 best = wedge.fairest();
  EXPECT_LT(wedge.loss(best), 0.7 * wedge.loss({0.47, 0.5, 0.44}));
  EXPECT_LE(wedge.gradient(best).norm(), 1e-5);
  for (int trial = 0; trial < 50; ++trial)
    EXPECT_GE(wedge.loss(best + random_vec(random, -0.1, 0.1)), wedge.loss(best) - 1e-12);
}

TEST(Fairness, AFaceThatIsLostIsWaitedForAsLongAsCanBe) {
  // A post that leans: with its centre of mass this low it stands on its foot, higher up it falls over.
  TriangleMesh post = box_mesh({0, 0, 0}, {1, 1, 2});
  for (Vec3& v : post.vertices)
    if (v[2] > 1) v[0] += 1;
  const Fairness fairness(convex_hull(post.vertices), {0.6, 0.5, 0.5});
  const std::vector<double> low = fairness.shares({0.6, 0.5, 0.5});
  const std::size_t faces = low.size();
  const Vec3 high(1.5, 0.5, 1.6);  // over the top's place, not over the foot
  EXPECT_EQ(std::ranges::count(low, 0), 0);
  EXPECT_EQ(std::ranges::count(fairness.shares(high), 0), 1);
  EXPECT_GT(fairness.loss(high), 0.9e4 / static_cast<double>(faces * faces));
  EXPECT_GE(fairness.loss({3, 3, 3}), fairness.loss(high)) << "outside is no place to be";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
