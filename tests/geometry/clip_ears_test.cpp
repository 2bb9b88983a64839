#include "geometry/clip_ears.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/fill_polygon.hpp"
#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Points = std::vector<Vec2>;

std::vector<std::uint32_t> count_to(std::size_t n) {
  std::vector<std::uint32_t> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = std::uint32_t(i);
  return all;
}

/// Triangles that run counter-clockwise, use every corner, and add up to the area: so they do not overlap.
void expect_filled(const Points& points, const std::vector<std::uint32_t>& polygon) {
  const auto triangles = clip_ears(points, polygon);
  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), polygon.size() - 2);
  double sum = 0, size = 0;
  std::vector<bool> used(points.size());
  for (const auto& t : *triangles) {
    EXPECT_GT(orient2d(points[t[0]], points[t[1]], points[t[2]]), 0);
    sum += 2 * area(polygon_of(points, t));
    for (const std::uint32_t v : t) used[v] = true;
  }
  for (const Vec2& p : points) size = std::max({size, std::abs(p[0]), std::abs(p[1])});
  for (const std::uint32_t v : polygon) EXPECT_TRUE(used[v]) << v;
  // Each product of two coordinates is rounded a few times.
  EXPECT_NEAR(sum, 2 * area(polygon_of(points, polygon)),
              16 * double(polygon.size()) * 0x1p-53 * size * size);
}

TEST(ClipEars, KeepsCornersOnStraightSides) {
  expect_filled({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {0, 2}, {0, 1}}, count_to(8));
  expect_filled({{0, 0}, {1, 0}, {2, 0}, {0, 2}}, count_to(4));  // a triangle with a fourth corner
}

TEST(ClipEars, StaysWithinConcavePolygons) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.1, 1);
  for (int n = 4; n < 60; ++n) {  // seen from its middle, every corner is in sight
    Points points;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * M_PI * i / n, r = radius(random);
      points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    expect_filled(points, count_to(points.size()));
  }
}

TEST(ClipEars, GoesToHolesAndBackByTheSameEdge) {
  // A square with a square hole; the edge between them is passed twice, by number or by place.
  const Points points = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {3, 6}, {6, 6}, {6, 3}};
  expect_filled(points, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4});
  Points twice = points;
  twice.push_back(points[0]);
  twice.push_back(points[4]);
  const auto triangles = clip_ears(twice, std::vector<std::uint32_t>{0, 1, 2, 3, 8, 4, 5, 6, 7, 9});
  ASSERT_TRUE(triangles);
  EXPECT_EQ(triangles->size(), 8u);
}

TEST(ClipEars, GoesRoundTwoHolesFromOneCorner) {
  const Points points = {{0, 0}, {20, 0}, {20, 9}, {0, 9},  {3, 3},  {3, 6},
                         {6, 6}, {6, 3},  {11, 3}, {11, 6}, {14, 6}, {14, 3}};
  expect_filled(points, {0, 1, 2, 3, 0, 4, 5, 6, 7, 8, 9, 10, 11, 8, 7, 4});
  expect_filled(points, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4, 0, 8, 9, 10, 11,
                         8});  // two edges from the corner, crossing none
}

TEST(ClipEars, TakesAHoleThatTouchesTheOutline) {
  const Points points = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {2, 5}, {5, 2}};
  expect_filled(points, {0, 4, 5, 0, 1, 2, 3});
}

TEST(ClipEars, RefusesAPolygonThatCrossesItself) {
  EXPECT_FALSE(clip_ears(Points{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, count_to(4)));
  EXPECT_FALSE(clip_ears(Points{{0, 0}, {0, 2}, {2, 2}, {2, 0}}, count_to(4)));  // clockwise
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
