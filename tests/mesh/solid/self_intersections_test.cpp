#include "mesh/solid/self_intersections.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "body/models/geodesic.hpp"
#include "geometry/triangle_pair.hpp"
#include "mesh/query/equal_vertices.hpp"
#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

/// Two triangles over a common list of points, in both orders and all rotations.
bool meet(const std::vector<Vec3>& points, const Triangle& s, const Triangle& t) {
  const auto numbered = [&](const Triangle& n) {
    return NumberedTriangle{n, {points[n[0]], points[n[1]], points[n[2]]}};
  };
  const bool answer = intersect_improperly(numbered(s), numbered(t));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Triangle u{s[i], s[(i + 1) % 3], s[(i + 2) % 3]}, v{t[j], t[(j + 2) % 3], t[(j + 1) % 3]};
      EXPECT_EQ(intersect_improperly(numbered(u), numbered(v)), answer);
      EXPECT_EQ(intersect_improperly(numbered(v), numbered(u)), answer);
    }
  return answer;
}

const std::vector<Vec3> corner = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

std::vector<Vec3> with(const std::vector<Vec3>& more) {
  std::vector<Vec3> points = corner;
  points.insert(points.end(), more.begin(), more.end());
  return points;
}

TEST(TrianglePair, WithoutCommonCornersMeetsWhereverItTouches) {
  const auto other = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return meet(with({a, b, c}), {0, 1, 2}, {3, 4, 5});
  };
  EXPECT_TRUE(other({1, 1, -1}, {1, 1, 1}, {5, 5, 0}));       // pierces
  EXPECT_TRUE(other({1, 1, 0}, {1, 2, 1}, {2, 1, 1}));        // stands on it with a corner
  EXPECT_TRUE(other({-1, 1, -1}, {-1, 1, 1}, {5, 1, 0.5}));   // edge through edge
  EXPECT_TRUE(other({1, 1, 0}, {2, 1, 0}, {1, 2, 0}));        // lies inside, same plane
  EXPECT_TRUE(other({-9, -9, 0}, {20, -9, 0}, {-9, 20, 0}));  // lies around, same plane
  EXPECT_TRUE(other({4, 0, 0}, {9, 0, 0}, {9, 9, 0}));        // same place, other corner: touching counts
  EXPECT_FALSE(other({1, 1, 1e-300}, {1, 2, 1}, {2, 1, 1}));
  EXPECT_FALSE(other({4.5, 0, 0}, {9, 0, 0}, {9, 9, 0}));
  EXPECT_FALSE(other({3, 3, -1}, {3, 3, 1}, {5, 5, 0}));  // through the plane, beside the triangle
}

TEST(TrianglePair, WithACommonCornerMayTouchOnlyThere) {
  const auto other = [](const Vec3& b, const Vec3& c) { return meet(with({b, c}), {0, 1, 2}, {0, 3, 4}); };
  EXPECT_FALSE(other({-1, -1, 0}, {-1, 1, 0}));       // flat, beside
  EXPECT_FALSE(other({1, 1, 1}, {1, 1, -1e-3 + 1}));  // above
  EXPECT_FALSE(other({-1, -1, 1}, {-1, -1, -1}));     // through the plane behind the corner
  EXPECT_TRUE(other({1, 1, 1}, {1, 1, -1}));          // through the middle
  EXPECT_TRUE(other({9, 9, 1}, {9, 9, -1}));          // leaves through the far edge
  EXPECT_TRUE(other({2, 0, 0}, {0, -1, 1}));          // an edge lies along an edge
  EXPECT_TRUE(other({1, 1, 0}, {0, -1, 1}));          // an edge lies in the face
  EXPECT_TRUE(other({1, 2, 0}, {2, 1, 0}));           // flat, inside
  EXPECT_TRUE(other({-1, 1, 0}, {1, 1, 0}));          // flat, overlapping wedge
}

TEST(TrianglePair, WithACommonEdgeMayNotFoldFlat) {
  const auto other = [](const Vec3& c) { return meet(with({c}), {0, 1, 2}, {1, 0, 3}); };
  EXPECT_FALSE(other({1, -1, 0}));      // flat, on the other side
  EXPECT_FALSE(other({1, 1, 1e-300}));  // folded, but open
  EXPECT_TRUE(other({1, 1, 0}));        // folded flat
  EXPECT_TRUE(other({9, 1, 0}));
  EXPECT_TRUE(meet(corner, {0, 1, 2}, {0, 2, 1}));  // the same triangle, turned
}

TEST(SelfIntersections, AreNoneOnPlainSolids) {
  EXPECT_TRUE(self_intersections(box_mesh({0, 0, 0}, {1, 2, 3})).empty());
  EXPECT_TRUE(self_intersections(geodesic_sphere(20)).empty());
  EXPECT_TRUE(self_intersections(torus(40, 20)).empty());
  EXPECT_TRUE(self_intersections(soup(geodesic_sphere(6))).empty());  // equal places are shared
}

TEST(SelfIntersections, AreNoneWhereSolidsTouchAlongAnEdgeOrAtACorner) {
  EXPECT_TRUE(
      self_intersections(both(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({1, 1, 0}, {2, 2, 1}))).empty());
  EXPECT_TRUE(
      self_intersections(both(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({1, 1, 1}, {2, 2, 2}))).empty());
}

TEST(SelfIntersections, AreWhereSolidsShareAFace) {
  // Same cut of the common square: two pairs of equal triangles, and the two pairs across its diagonal.
  const Pairs pairs =
      self_intersections(both(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({0, 0, 1}, {1, 1, 2})));
  EXPECT_NE(std::find(pairs.begin(), pairs.end(), (std::array<std::uint32_t, 2>{2, 13})), pairs.end());
  EXPECT_GE(pairs.size(), 2u);
}

TEST(SelfIntersections, FindTheOneSpikeThroughAWall) {
  // A needle's tip through the face z = 1 of a box: its three sides meet one triangle of that face.
  TriangleMesh needle{{{0.2, 0.5, 2}, {0.3, 0.5, 2}, {0.2, 0.6, 2}, {0.23, 0.53, 0.9}},
                      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  const Pairs pairs = self_intersections(both(box_mesh({0, 0, 0}, {1, 1, 1}), needle));
  EXPECT_EQ(pairs, (Pairs{{3, 13}, {3, 14}, {3, 15}}));
}

TEST(SelfIntersections, AgreeWithTryingEveryPair) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 10), step(-1, 1);
  TriangleMesh mesh;
  for (int i = 0; i < 400; ++i) {
    const Vec3 p(place(random), place(random), place(random));
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(p + Vec3(step(random), step(random), step(random)));
    const auto n = std::uint32_t(mesh.vertices.size());
    mesh.triangles.push_back({n - 3, n - 2, n - 1});
    if (i % 4 == 0 && i) mesh.triangles.back()[0] = n - 6;  // some with a common corner
  }
  Pairs want;
  const auto numbered = [&](std::uint32_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return NumberedTriangle{mesh.triangles[t], {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}};
  };
  for (std::uint32_t i = 0; i < 400; ++i)
    for (std::uint32_t j = i + 1; j < 400; ++j)
      if (intersect_improperly(numbered(i), numbered(j))) want.push_back({i, j});
  EXPECT_GT(want.size(), 20u);
  EXPECT_EQ(self_intersections(mesh), want);
}

TEST(SelfIntersections, DoNotDependOnWhereTheMeshIs) {
  TriangleMesh two = both(geodesic_sphere(8), geodesic_sphere(8));
  for (std::size_t v = two.vertices.size() / 2; v < two.vertices.size(); ++v)
    two.vertices[v] += Vec3(1, 0.5, 0.25);
  const Pairs here = self_intersections(two);
  EXPECT_FALSE(here.empty());
  for (Vec3& v : two.vertices) v = 1024 * v;  // exact
  EXPECT_EQ(self_intersections(two), here);
}

TEST(SelfIntersections, PassOverTrianglesWithoutArea) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({0.5, 0.5, 0.5});
  mesh.triangles.push_back({0, 8, 7});  // on one line, straight through the box
  mesh.triangles.push_back({0, 0, 8});
  EXPECT_TRUE(self_intersections(mesh).empty());
}

TEST(EqualVertices, NamesTheFirstOfEachPlace) {
  EXPECT_EQ(first_equal_vertex({{1, 0, 0}, {0, 0, 0}, {1, -0.0, 0}, {0, 0, 1e-320}, {-0.0, 0, 0}}),
            (std::vector<std::uint32_t>{0, 1, 0, 3, 1}));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
