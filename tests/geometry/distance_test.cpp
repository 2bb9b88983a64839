#include "geometry/distance.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);

TEST(DistanceToTriangle, IsExactInEveryRegionAroundIt) {
  const auto distance = [](const Vec3& p) { return distance_to_triangle(p, a, b, c); };
  EXPECT_EQ(distance({1, 1, 3}), 3) << "above the face";
  EXPECT_EQ(distance({1, 1, -3}), 3) << "below the face";
  EXPECT_EQ(distance({1, 1, 0}), 0) << "on the face";
  EXPECT_EQ(distance({2, -3, 4}), 5) << "beside ab";
  EXPECT_EQ(distance({-4, 1, 3}), 5) << "beside ca";
  EXPECT_DOUBLE_EQ(distance({4, 4, 0}), std::sqrt(8.0)) << "beside bc";
  EXPECT_EQ(distance({-3, -4, 0}), 5) << "corner a";
  EXPECT_EQ(distance({7, 0, 4}), 5) << "corner b";
  EXPECT_EQ(distance({0, 8, 3}), 5) << "corner c";
  EXPECT_EQ(distance(a), 0);
  EXPECT_EQ(distance({2, 0, 0}), 0) << "on an edge";
}

TEST(DistanceToTriangle, DoesNotDependOnTheOrderOfCorners) {
  Random random(21);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 p = random_vec(random, -2, 2), u = random_vec(random, -1, 1), v = random_vec(random, -1, 1),
               w = random_vec(random, -1, 1);
    const double d = distance_to_triangle(p, u, v, w);
    // Cross products of differences of order one; slim triangles lose some digits, hence 2^-40.
    for (const double other : {distance_to_triangle(p, v, w, u), distance_to_triangle(p, w, u, v),
                               distance_to_triangle(p, v, u, w)})
      EXPECT_NEAR(other, d, 0x1p-40);
  }
}

TEST(DistanceToTriangle, IsNeverMoreThanToAnyOfItsPoints) {
  Random random(22);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 p = random_vec(random, -2, 2), u = random_vec(random, -1, 1), v = random_vec(random, -1, 1),
               w = random_vec(random, -1, 1);
    const double d = distance_to_triangle(p, u, v, w);
    double least = std::numeric_limits<double>::infinity();
    constexpr int steps = 60;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
        least = std::min(least, (p - (u + s * (v - u) + t * (w - u))).norm());
      }
    EXPECT_LE(d, least + 0x1p-40);
    // The samples are at most one step of an edge (<= 2 sqrt 3) apart.
    EXPECT_GE(d, least - 2 * std::sqrt(3.0) / steps);
  }
}

TEST(DistanceToTriangle, OfADegenerateOneIsThatToItsSegmentOrPoint) {
  EXPECT_EQ(distance_to_triangle({1, 3, 4}, a, b, b), 5) << "segment";
  EXPECT_EQ(distance_to_triangle({1, 3, 4}, a, {2, 0, 0}, b), 5) << "three points in a line";
  EXPECT_EQ(distance_to_triangle({0, 3, 4}, a, a, a), 5) << "point";
}

TEST(NearestOnTriangle, IsAsNearAsTheDistanceSays) {
  Random random(23);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 p = random_vec(random, -2, 2), u = random_vec(random, -1, 1), v = random_vec(random, -1, 1),
               w = random_vec(random, -1, 1);
    const Vec3 q = nearest_on_triangle(p, u, v, w);
    EXPECT_NEAR((p - q).norm(), distance_to_triangle(p, u, v, w), 0x1p-40) << "as above";
    EXPECT_LE(distance_to_triangle(q, u, v, w), 0x1p-40) << "lies on it";
  }
  EXPECT_EQ(nearest_on_triangle({1, 1, 3}, a, b, c), Vec3(1, 1, 0));
  EXPECT_EQ(nearest_on_triangle({2, -3, 4}, a, b, c), Vec3(2, 0, 0));
  EXPECT_EQ(nearest_on_triangle({7, 0, 4}, a, b, c), b);
  EXPECT_EQ(nearest_on_triangle({1, 3, 4}, a, b, b), Vec3(1, 0, 0)) << "a segment";
}

TEST(NearestOnSegment, IsTheFootOrAnEnd) {
  using Vec2 = Eigen::Vector2d;
  const Vec2 from(1, 1), to(5, 1);
  EXPECT_EQ(nearest_on_segment(Vec2(2, 7), from, to), Vec2(2, 1));
  EXPECT_EQ(nearest_on_segment(Vec2(-3, 0), from, to), from);
  EXPECT_EQ(nearest_on_segment(Vec2(6, 4), from, to), to);
  EXPECT_EQ(nearest_on_segment(Vec2(6, 4), from, from), from) << "a point";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
