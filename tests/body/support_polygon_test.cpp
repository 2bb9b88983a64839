#include "body/support_polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "domain/test_bodies.hpp"
#include "error.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Coordinates of order one, a handful of roundings each.
constexpr double round_off = 64 * 0x1p-53;

/// Corners in the order of the polygon, from the first of `want` on.
void expect_corners(const SupportPolygon& got, const std::vector<Vec2>& want, double tolerance = round_off) {
  ASSERT_EQ(got.corners.size(), want.size());
  ASSERT_EQ(got.edges.size(), want.size());
  std::size_t first = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    if ((got.corners[i] - want[0]).norm() < (got.corners[first] - want[0]).norm()) first = i;
  for (std::size_t i = 0; i < want.size(); ++i)
    EXPECT_LE((got.corners[(first + i) % want.size()] - want[i]).norm(), tolerance) << "corner " << i;
}

/// Each edge holds its two corners on its line and all others inside; normals are unit.
void expect_consistent(const SupportPolygon& p, double tolerance = round_off) {
  const std::size_t n = p.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto& e = p.edges[i];
    EXPECT_NEAR(e.n.norm(), 1, tolerance);
    EXPECT_NEAR(e.n.dot(p.corners[i]), e.d, tolerance);
    EXPECT_NEAR(e.n.dot(p.corners[(i + 1) % n]), e.d, tolerance);
    for (const Vec2& c : p.corners) EXPECT_LE(e.n.dot(c), e.d + tolerance);
  }
}

const std::vector<Vec2> square = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};

TEST(HullOf, ARectangleIsItself) {
  const SupportPolygon p = hull_of({square[2], square[0], square[3], square[1]});
  expect_corners(p, square, 0);
  expect_consistent(p);
  EXPECT_EQ(p.area, 2);
  EXPECT_NEAR((p.centroid - Vec2(1, 0.5)).norm(), 0, round_off);
}

TEST(HullOf, ATriangleHasItsCentroidAtTheMeanOfItsCorners) {
  const SupportPolygon p = hull_of({{3, 1}, {0, 0}, {1, 4}});
  expect_corners(p, {{0, 0}, {3, 1}, {1, 4}}, 0);
  EXPECT_NEAR(p.area, 5.5, round_off);
  EXPECT_NEAR((p.centroid - Vec2(4, 5) / 3).norm(), 0, round_off);
}

TEST(HullOf, LeavesOutInnerPointsDuplicatesAndPointsOfAnEdge) {
  std::vector<Vec2> points;
  for (const Vec2& a : square)
    for (const Vec2& b : square)
      for (const double t : {0.0, 0.25, 0.5, 1.0}) points.push_back(a + t * (b - a));
  const SupportPolygon p = hull_of(points);
  expect_corners(p, square, 0);
  EXPECT_EQ(p.area, 2);
}

TEST(HullOf, PointsWithoutAnAreaHaveNoCorners) {
  EXPECT_TRUE(hull_of({}).corners.empty());
  EXPECT_TRUE(hull_of({{1, 2}}).corners.empty());
  EXPECT_TRUE(hull_of({{1, 2}, {3, 4}}).corners.empty());
  EXPECT_TRUE(hull_of(std::vector<Vec2>(7, Vec2(1, 2))).corners.empty());
  std::vector<Vec2> line;
  for (int i = 0; i < 9; ++i) line.emplace_back(0.1 * i, 0.3 * i + 1);  // rounds to either side of the line
  EXPECT_TRUE(hull_of(line).corners.empty());
  EXPECT_EQ(hull_of(line).area, 0);
}

/// The grid of a subdivided square, as the base of a body that was turned into its frame: points of an edge
/// lie on either side of its line by round-off, and those of the first edge are sorted by round-off alone.
TEST(HullOf, ASubdividedSquareKeepsItsFourCornersHoweverItIsTurned) {
  Random random(71);
  for (int trial = 0; trial < 200; ++trial) {
    // Multiples of a right angle are the worst: whole edges share a coordinate up to round-off.
    const double angle = trial % 2 ? uniform(random, 0, 7) : std::numbers::pi / 2 * (trial % 8 / 2);
    const Eigen::Rotation2Dd turn(angle);
    const Vec2 shift(uniform(random, -3, 3), uniform(random, -3, 3));
    std::vector<Vec2> points, corners;
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; j <= 6; ++j) points.push_back(turn * Vec2(i / 6.0, j / 6.0) + shift);
    for (Vec2& p : points)  // a unit in the last place more or less
      p += Vec2(uniform(random, -1, 1), uniform(random, -1, 1)) * 0x1p-51;
    for (const Vec2& c : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
      corners.push_back(turn * c + shift);
    const SupportPolygon p = hull_of(points);
    SCOPED_TRACE(trial);
    expect_corners(p, corners);
    expect_consistent(p);
    EXPECT_NEAR(p.area, 1, round_off);
    EXPECT_NEAR((p.centroid - turn * Vec2(0.5, 0.5) - shift).norm(), 0, round_off);
  }
}

TEST(HullOf, ACircleKeepsEveryPoint) {
  std::vector<Vec2> circle;
  const int n = 1000;  // a corner sticks out by (2 pi / n)^2 / 2 of the radius, far beyond round-off
  for (int i = 0; i < n; ++i)
    circle.emplace_back(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n));
  const SupportPolygon p = hull_of(circle);
  EXPECT_EQ(p.corners.size(), circle.size());
  EXPECT_NEAR(p.area, n / 2.0 * std::sin(2 * std::numbers::pi / n), n * round_off);
  EXPECT_NEAR(p.centroid.norm(), 0, n * round_off);
}

TEST(SupportPolygonInside, IsTheDistanceFromTheNearestEdge) {
  const SupportPolygon p = hull_of(square);
  EXPECT_NEAR(p.inside({1, 0.5}), 0.5, round_off);
  EXPECT_NEAR(p.inside({0.25, 0.5}), 0.25, round_off);
  EXPECT_NEAR(p.inside({1, 0}), 0, round_off);
  EXPECT_NEAR(p.inside({2.75, 0.5}), -0.75, round_off);
  EXPECT_NEAR(p.inside({2.75, 1.25}), -0.75, round_off) << "of the lines, not of the corner";
}

TEST(SupportPolygonNearest, IsThePointItselfInsideElseOnAnEdgeOrACorner) {
  const SupportPolygon p = hull_of(square);
  EXPECT_EQ(p.nearest({0.25, 0.5}), Vec2(0.25, 0.5));
  EXPECT_NEAR((p.nearest({1.25, -3}) - Vec2(1.25, 0)).norm(), 0, round_off);
  EXPECT_NEAR((p.nearest({2.75, 0.5}) - Vec2(2, 0.5)).norm(), 0, round_off);
  EXPECT_NEAR((p.nearest({2.75, 1.25}) - Vec2(2, 1)).norm(), 0, round_off);
}

TEST(SupportPolygonNearest, NoOtherPointOfThePolygonIsNearer) {
  Random random(72);
  const SupportPolygon p = hull_of({{3, 1}, {0, 0}, {1, 4}, {-1, 2}});
  for (int trial = 0; trial < 200; ++trial) {
    const Vec2 from(uniform(random, -6, 6), uniform(random, -6, 6)), found = p.nearest(from);
    EXPECT_GE(p.inside(found), -round_off);
    for (std::size_t i = 0; i < p.corners.size(); ++i)
      for (int k = 0; k < 20; ++k) {
        const Vec2 other = p.corners[i] + k / 20.0 * (p.corners[(i + 1) % p.corners.size()] - p.corners[i]);
        if (p.inside(from) < 0) {
          EXPECT_LE((found - from).norm(), (other - from).norm() + round_off);
        }
      }
  }
}

TEST(Shrunk, ARightTriangleIsScaledAboutItsIncentre) {
  // Sides 3, 4, 5: the inscribed circle has radius 1 and its centre at (1, 1).
  const SupportPolygon triangle = hull_of({{0, 0}, {4, 0}, {0, 3}});
  const Vec2 incentre(1, 1);
  for (const double margin : {0.25, 0.5, 0.96}) {
    const auto scaled = [&](const Vec2& corner) {
      return Vec2(incentre + (1 - margin) * (corner - incentre));
    };
    expect_corners(shrunk(triangle, margin), {scaled({0, 0}), scaled({4, 0}), scaled({0, 3})});
  }
  expect_corners(shrunk(triangle, 0), triangle.corners, 0);
  EXPECT_TRUE(shrunk(triangle, 1.01).corners.empty());
}

TEST(Shrunk, AShortEdgeIsLost) {
  // A square with one corner cut off by 0.2: at a margin of 0.5 its neighbours meet before it.
  const SupportPolygon p = hull_of({{0, 0}, {2, 0}, {2, 1.8}, {1.8, 2}, {0, 2}});
  expect_corners(shrunk(p, 0.5), {{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}});
}

TEST(SupportPolygon, OfABoxIsItsBase) {
  const Body body = body_of(box_mesh({-0.5, -0.25, 0.3}, {0.75, 0.5, 1.5}));
  const SupportPolygon p = support_polygon(body);
  expect_corners(p, {{-0.5, -0.25}, {0.75, -0.25}, {0.75, 0.5}, {-0.5, 0.5}}, 0);
  EXPECT_NEAR((p.centroid - Vec2(0.125, 0.125)).norm(), 0, round_off);
  EXPECT_NEAR(p.area, 1.25 * 0.75, round_off);
}

/// A table top with three legs, each a tetrahedron that ends in a point.
TriangleMesh tripod(const std::vector<Vec3>& feet) {
  TriangleMesh mesh = box_mesh({-1, -1, 0.5}, {1, 1, 0.7});
  for (const Vec3& foot : feet) {
    const Vec3 top(foot[0], foot[1], 0.6);
    const TriangleMesh leg =
        tetrahedron_mesh(top + Vec3(0.1, 0, 0), top + Vec3(-0.1, 0.1, 0), top + Vec3(-0.1, -0.1, 0), foot);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), leg.vertices.begin(), leg.vertices.end());
    for (const Triangle& t : leg.triangles)
      mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return mesh;
}

TEST(SupportPolygon, OfATripodIsTheTriangleOfItsFeet) {
  const SupportPolygon p = support_polygon(body_of(tripod({{-0.8, -0.7, 0}, {0.9, -0.6, 0}, {0.1, 0.8, 0}})));
  expect_corners(p, {{-0.8, -0.7}, {0.9, -0.6}, {0.1, 0.8}}, 0);
  EXPECT_NEAR((p.centroid - Vec2(0.2, -0.5) / 3).norm(), 0, round_off);
}

TEST(SupportPolygon, TakesVerticesWithinItsShareOfTheHeight) {
  // Height 0.7: a thousandth is 0.0007.
  const auto corners = [](double lift, double tolerance) {
    const Body body =
        body_of(tripod({{-0.8, -0.7, 0}, {0.9, -0.6, 0}, {0.1, 0.8, 0}, {-0.9, 0.7, lift}, {0.8, 0.5, 0.2}}));
    return support_polygon(body, tolerance).corners.size();
  };
  EXPECT_EQ(corners(0.00069, 1e-3), 4u);
  EXPECT_EQ(corners(0.00071, 1e-3), 3u);
  EXPECT_EQ(corners(0.00071, 1.1e-3), 4u);
  EXPECT_EQ(corners(1e-9, 0), 3u) << "no tolerance, no other vertex";
  EXPECT_EQ(corners(0.1, 0.3), 5u) << "the fifth leg ends at 0.2 of 0.7";
}

std::string refusal(const TriangleMesh& mesh, double length = 1) {
  try {
    (void)support_polygon(body_of(mesh, length));
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("test has no base to stand on"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("expected three or more corners"), std::string::npos) << e.what();
    return e.what();
  }
  return "accepted";
}

TEST(SupportPolygon, APointAnEdgeOrASliverIsNoBase) {
  const Eigen::Matrix3d on_edge = Eigen::AngleAxisd(0.5, Vec3::UnitY()).toRotationMatrix();
  const Eigen::Matrix3d on_point = Eigen::AngleAxisd(0.5, Vec3(1, 2, 0).normalized()).toRotationMatrix();
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_NE(refusal(moved(box, on_edge, {0, 0, 0})).find(": 2 of its vertices lie within 0.1 %"),
            std::string::npos);
  EXPECT_NE(refusal(moved(box, on_point, {0, 0, 0})).find(": 1 of its vertices"), std::string::npos);
  // A base of 0.02 x 0.008 = 1.6e-4 carries (limit 1e-4), one of half the width does not; in mm^2 at 50 mm.
  const auto column = [](double width) {
    return tripod({{0, 0, 0}, {0.02, 0, 0}, {0.02, width, 0}, {0, width, 0}});
  };
  EXPECT_EQ(refusal(column(0.008)), "accepted");
  EXPECT_NE(refusal(column(0.004), 50).find("span 0.2 mm^2"), std::string::npos)
      << refusal(column(0.004), 50);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
