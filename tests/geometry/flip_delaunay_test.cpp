#include "geometry/flip_delaunay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "body/test_meshes.hpp"
#include "geometry/fill_polygon.hpp"
#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

std::vector<std::uint32_t> counted(std::size_t n) {
  std::vector<std::uint32_t> loop(n);
  std::iota(loop.begin(), loop.end(), 0u);
  return loop;
}

double area_of(const std::vector<Vec2>& points, const Triangles& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += area(polygon_of(points, t));
  return sum;
}

/// Is d inside the circle through a triangle? By the determinant of the lifted points.
bool in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  Eigen::Matrix3d m;
  int row = 0;
  for (const Vec2* p : {&a, &b, &c}) {
    const double x = (*p)[0] - d[0], y = (*p)[1] - d[1];
    m.row(row++) << x, y, x * x + y * y;
  }
  return m.determinant() > 1e-12;
}

TEST(FlipDelaunay, LeavesNoCornerOfAConvexRegionInAnyCircle) {
  Random random(11);
  std::vector<Vec2> points;
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::numbers::pi * (i + uniform(random, 0, 0.9)) / 60;
    points.emplace_back(2 * std::cos(angle), std::sin(angle));
  }
  const Triangles found = fill_polygon(points, {counted(points.size())});
  ASSERT_EQ(found.size(), points.size() - 2);
  for (const auto& t : found)
    for (const Vec2& p : points) EXPECT_FALSE(in_circle(points[t[0]], points[t[1]], points[t[2]], p));
}

TEST(FlipDelaunay, MakesNoSliverOfPointsAlongARim) {
  // A frame whose rims bulge by less than any file's precision, as the cut of a flat wall does.
  std::vector<Vec2> points;
  std::vector<std::vector<std::uint32_t>> loops(2);
  constexpr int n = 40;
  const auto add = [&](std::vector<std::uint32_t>& loop, double half, bool turned) {
    const Vec2 corners[] = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    for (int side = 0; side < 4; ++side)
      for (int i = 0; i < n; ++i) {
        const Vec2 &a = corners[side], &b = corners[(side + 1) % 4];
        const double t = double(i) / n, bulge = 1e-9 * t * (1 - t);
        loop.push_back(std::uint32_t(points.size()));
        points.push_back((a + t * (b - a)) * (1 + bulge));
      }
    if (turned) std::ranges::reverse(loop);
  };
  add(loops[0], 10, false);
  add(loops[1], 7, true);
  const Triangles found = fill_polygon(points, loops);
  EXPECT_EQ(found.size(), points.size());  // vertices - 2 + 2 a hole
  EXPECT_NEAR(area_of(points, found), 400 - 196, 1e-6);
  for (const auto& t : found) {
    EXPECT_GT(orient2d(points[t[0]], points[t[1]], points[t[2]]), 0);
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec2 &a = points[t[std::size_t(k)]], &b = points[t[std::size_t(k + 1) % 3]];
      longest = std::max(longest, std::hypot(b[0] - a[0], b[1] - a[1]));
    }
    EXPECT_GT(2 * area(polygon_of(points, t)) / longest, 0.1) << "height of a triangle";
  }
}

TEST(FlipDelaunay, KeepsTheRim) {
  // A star: most better edges would leave it.
  std::vector<Vec2> points;
  for (int i = 0; i < 20; ++i) {
    const double r = i % 2 ? 0.2 : 1, angle = std::numbers::pi * i / 10;
    points.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  const Triangles found = fill_polygon(points, {counted(20)});
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const auto& t : found)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(sides.insert({t[k], t[(k + 1) % 3]}).second);
  for (std::uint32_t i = 0; i < 20; ++i) {
    EXPECT_TRUE(sides.contains({i, (i + 1) % 20}));
    EXPECT_FALSE(sides.contains({(i + 1) % 20, i}));
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
