#include "geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kreisel::core {
namespace THIS_FILE {

/// A square of side 3 with a notch up to its middle: 9 - 3 * 1.5 / 2.
const Polygon notched = {{0, 0}, {3, 0}, {3, 3}, {1.5, 1.5}, {0, 3}};

TEST(Polygon, HasAreaAndCentroid) {
  const Polygon square = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  EXPECT_DOUBLE_EQ(area(square), 16);
  const Polygon triangle = {{100, 0}, {103, 0}, {100, 6}};
  EXPECT_DOUBLE_EQ(area(triangle), 9);
  EXPECT_NEAR((centroid(triangle) - Vec2(101, 2)).norm(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(area(notched), 6.75);
  // Square less triangle: (9 * 1.5 - 2.25 * 2.5) / 6.75.
  EXPECT_NEAR((centroid(notched) - Vec2(1.5, 7.875 / 6.75)).norm(), 0, 16 * 0x1p-52);
}

TEST(Polygon, TheOtherWayRoundHasNegativeArea) {
  Polygon reversed = notched;
  std::ranges::reverse(reversed);
  EXPECT_DOUBLE_EQ(area(reversed), -6.75);
  EXPECT_NEAR((centroid(reversed) - centroid(notched)).norm(), 0, 16 * 0x1p-52);
}

TEST(Polygon, ContainsWhatLiesWithin) {
  EXPECT_TRUE(contains(notched, {0.1, 0.1}));
  EXPECT_TRUE(contains(notched, {1.5, 1.4}));
  EXPECT_FALSE(contains(notched, {1.5, 1.6})) << "in the notch";
  EXPECT_FALSE(contains(notched, {3.1, 1}));
  EXPECT_FALSE(contains(notched, {-1, 3})) << "level with two corners";
  EXPECT_TRUE(contains(notched, {2.5, 1.5})) << "level with a corner";
}

TEST(Polygon, KnowsWhatOfItsBorderIsNearest) {
  EXPECT_EQ(nearest_on_border(notched, {1, -2}), Vec2(1, 0)) << "from outside";
  EXPECT_EQ(nearest_on_border(notched, {2.75, 1}), Vec2(3, 1)) << "from inside";
  EXPECT_EQ(nearest_on_border(notched, {4, 4}), Vec2(3, 3)) << "a corner";
  EXPECT_NEAR((nearest_on_border(notched, {1.6, 2}) - Vec2(1.8, 1.8)).norm(), 0, 1e-15) << "in the notch";
}

TEST(Polygon, OfALoopHasItsCorners) {
  const std::vector<Vec2> points = {{0, 0}, {5, 5}, {1, 0}, {0, 1}};
  const Loop loop = {0, 2, 3};
  EXPECT_EQ(polygon_of(points, loop), (Polygon{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_DOUBLE_EQ(area(polygon_of(points, loop)), 0.5);
}

TEST(Circle, HasTheAreaOfARegularPolygon) {
  const Polygon ring = circle({5, -3}, 2, 24);
  ASSERT_EQ(ring.size(), 24u);
  EXPECT_EQ(ring.front(), Vec2(7, -3));
  EXPECT_NEAR(area(ring), 12 * 4 * std::sin(2 * std::numbers::pi / 24), 1e-13);
  EXPECT_NEAR((centroid(ring) - Vec2(5, -3)).norm(), 0, 1e-13);
}

TEST(Cross, IsPositiveToTheLeft) {
  EXPECT_EQ(cross({2, 0}, {1, 3}), 6);
  EXPECT_EQ(cross({1, 3}, {2, 0}), -6);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
