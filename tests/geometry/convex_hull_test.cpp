#include "geometry/convex_hull.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "body/test_meshes.hpp"
#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Closed, no point beyond a facet (by exact signs), neighbours that know each other.
void expect_hull(const ConvexHull& hull, const std::vector<Vec3>& points) {
  ASSERT_EQ(hull.facets.size(), hull.beside.size());
  EXPECT_EQ(hull.facets.size(), 2 * hull.vertices.size() - 4) << "Euler's formula";
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    for (const Vec3& p : points)
      ASSERT_LE(orient3d(hull.corner(f, 0), hull.corner(f, 1), hull.corner(f, 2), p), 0) << "facet " << f;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t next = hull.beside[f][k];
      const auto shared = [&](std::uint32_t v) {
        return hull.facets[next][0] == v || hull.facets[next][1] == v || hull.facets[next][2] == v;
      };
      EXPECT_TRUE(shared(hull.facets[f][k]) && shared(hull.facets[f][(k + 1) % 3]));
    }
  }
}

TEST(ConvexHull, OfRandomPointsHasNoneOutside) {
  Random random(301);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vec3> points;
    for (int i = 0; i < 10 * (trial + 1); ++i) points.push_back(random_vec(random, -1, 1));
    expect_hull(convex_hull(points), points);
  }
}

TEST(ConvexHull, OfPointsInCommonPlanesIsStillClosed) {
  // A grid on and in a cube: most points lie in the planes of six faces, on edges, twice.
  std::vector<Vec3> points;
  for (int repeat = 0; repeat < 2; ++repeat)
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j)
        for (int k = 0; k <= 4; ++k) points.emplace_back(i, j, k);
  const ConvexHull hull = convex_hull(points);
  expect_hull(hull, points);
  double area = 0;
  for (std::size_t f = 0; f < hull.facets.size(); ++f)
    area += (hull.corner(f, 1) - hull.corner(f, 0)).cross(hull.corner(f, 2) - hull.corner(f, 0)).norm() / 2;
  EXPECT_NEAR(area, 6 * 16, 1e-12);
}

TEST(ConvexHull, OfASphereKeepsAllItsPoints) {
  Random random(302);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) points.push_back(random_vec(random, -1, 1).normalized());
  const ConvexHull hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), points.size());
  expect_hull(hull, points);
}

TEST(ConvexHull, OfPointsInAPlaneHasNoFacets) {
  std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(convex_hull(points).facets.empty());
  points.emplace_back(0.3, 0.3, 0);
  points.emplace_back(2, 3, 0);
  EXPECT_TRUE(convex_hull(points).facets.empty());
  EXPECT_TRUE(convex_hull({}).facets.empty());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
