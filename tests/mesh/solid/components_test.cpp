#include "mesh/solid/components.hpp"

#include <gtest/gtest.h>

#include "body/models/geodesic.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Shells, MeasureABox) {
  const auto all = shells(box_mesh({1, 2, 3}, {3, 5, 7}));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all[0].closed);
  EXPECT_TRUE(all[0].oriented);
  EXPECT_EQ(all[0].euler, 2);
  EXPECT_EQ(all[0].genus, 0);
  EXPECT_DOUBLE_EQ(all[0].volume, 24);
  EXPECT_EQ(all[0].box.lo, Vec3(1, 2, 3));
  EXPECT_EQ(all[0].box.hi, Vec3(3, 5, 7));
}

TEST(Shells, CountHandles) {
  const auto all = shells(both(torus(12, 8), inverted(geodesic_sphere(3))));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].euler, 0);
  EXPECT_EQ(all[0].genus, 1);
  EXPECT_GT(all[0].volume, 0);
  EXPECT_EQ(all[1].genus, 0);
  EXPECT_LT(all[1].volume, 0);
}

TEST(Shells, HaveNoGenusWhenOpenOrOneSided) {
  TriangleMesh open = box_mesh({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  const auto disc = shells(open);
  EXPECT_FALSE(disc[0].closed);
  EXPECT_EQ(disc[0].euler, 1);  // a disc
  EXPECT_FALSE(disc[0].genus);
  const auto klein = shells(torus(8, 6, /*twisted=*/true));
  EXPECT_TRUE(klein[0].closed);
  EXPECT_FALSE(klein[0].oriented);
  EXPECT_EQ(klein[0].euler, 0);
  EXPECT_FALSE(klein[0].genus);
}

TEST(Shells, AreSeparateWhereTheyMerelyTouchInAVertex) {
  TriangleMesh mesh = both(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({1, 1, 1}, {2, 2, 2}));
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t)
      if (v == 8) v = 7;  // both corners at (1, 1, 1)
  const auto all = shells(mesh);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].genus, 0);
  EXPECT_EQ(all[1].genus, 0);
  EXPECT_EQ(inspect(mesh).pinched_vertex_count, 1u);
  EXPECT_EQ(inspect(mesh).unused_vertex_count, 1u);
}

TEST(Nesting, ListsTheShellsAround) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {10, 10, 10});
  mesh = both(mesh, box_mesh({1, 1, 1}, {6, 6, 6}));
  mesh = both(mesh, box_mesh({2, 2, 2}, {3, 3, 3}));
  mesh = both(mesh, box_mesh({7, 7, 7}, {9, 9, 9}));
  mesh = both(mesh, box_mesh({20, 0, 0}, {21, 1, 1}));
  using Lists = std::vector<std::vector<std::uint32_t>>;
  EXPECT_EQ(enclosing_shells(mesh, shells(mesh)), (Lists{{}, {0}, {0, 1}, {0}, {}}));
}

TEST(Nesting, LooksAtTheSurfaceNotAtTheBox) {
  // A ball in the hole of a ring: inside its box, not inside it. The ray from it meets edges of the ring's
  // grid.
  TriangleMesh ring = torus(64, 32);
  TriangleMesh ball = geodesic_sphere(3);
  for (Vec3& v : ball.vertices) v *= 0.5;
  TriangleMesh inner = ball;
  for (Vec3& v : inner.vertices) v += Vec3(3, 0, 0);
  const TriangleMesh mesh = both(both(ring, ball), inner);
  using Lists = std::vector<std::vector<std::uint32_t>>;
  EXPECT_EQ(enclosing_shells(mesh, shells(mesh)), (Lists{{}, {}, {0}}));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
