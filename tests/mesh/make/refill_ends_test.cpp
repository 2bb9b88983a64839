#include "mesh/make/refill_ends.hpp"

#include <gtest/gtest.h>

#include "mesh/make/prism.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(RefillEnds, MendsAnEdgeOnTheWrongSideOfACorner) {
  // A dart whose notch comes near to the opposite edge; its end is cut by a fan that does not see the notch.
  const Polygon dart = {{0, 0}, {4, 0}, {4, 3}, {2, 0.5}};
  TriangleMesh mesh = prism(dart, 0, 1);
  std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] >= 4 && t[1] >= 4 && t[2] >= 4; });
  mesh.triangles.push_back({5, 6, 7});
  mesh.triangles.push_back({5, 7, 4});
  std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] < 4 && t[1] < 4 && t[2] < 4; });
  // Wrong: over the notch.
  mesh.triangles.push_back({0, 2, 1});
  mesh.triangles.push_back({0, 3, 2});
  ASSERT_FALSE(self_intersections(mesh).empty());
  refill_ends(mesh);
  EXPECT_NO_THROW(require_solid(mesh, "dart"));
  EXPECT_TRUE(self_intersections(mesh).empty());
}

TEST(RefillEnds, KeepsHolesAndWhatIsBetween) {
  const TriangleMesh around = prism(Polygon{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0, 2);
  TriangleMesh mesh = both(around, moved(around, Eigen::Matrix3d::Identity(), {10, 0, 0}));
  const std::size_t triangles = mesh.triangles.size();
  refill_ends(mesh);
  EXPECT_EQ(mesh.triangles.size(), triangles);
  EXPECT_NO_THROW(require_solid(mesh, "two boxes"));
}

TEST(RefillEnds, LeavesAnEndWithACornerInside) {
  TriangleMesh pyramid{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5, 0.5, 1}},
      {{1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}, {0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 0, 5}}};
  const auto before = pyramid.triangles;
  refill_ends(pyramid);
  EXPECT_EQ(pyramid.triangles.size(), before.size());
  EXPECT_NO_THROW(require_solid(pyramid, "pyramid"));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
