#include "geometry/triangle.hpp"

#include <gtest/gtest.h>

#include "body/test_meshes.hpp"
#include "geometry/moved.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const TriangleMesh mesh = {{{0, 0, 0}, {9, 9, 9}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}},
                           {{0, 2, 3}, {0, 3, 4}, {4, 2, 0}}};

TEST(Triangle, HasCornersNormalAndMiddle) {
  const auto [a, b, c] = corners_of(mesh, mesh.triangles[0]);
  EXPECT_EQ(a, Vec3(0, 0, 0));
  EXPECT_EQ(b, Vec3(2, 0, 0));
  EXPECT_EQ(c, Vec3(0, 3, 0));
  EXPECT_EQ(normal_of(mesh, mesh.triangles[0]), Vec3(0, 0, 6)) << "twice the area, counter-clockwise";
  EXPECT_EQ(normal_of(a, c, b), Vec3(0, 0, -6));
  EXPECT_EQ(middle_of(mesh, mesh.triangles[0]), Vec3(2.0 / 3, 1, 0));
}

TEST(Moved, TakesAnyMap) {
  const Eigen::Matrix3d twice = 2 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(moved(mesh, twice).vertices[3], Vec3(0, 6, 0));
  EXPECT_EQ(moved(mesh, Eigen::Affine3d(Eigen::Translation3d(1, 2, 3))).vertices[4], Vec3(1, 2, 7));
  EXPECT_EQ(moved(mesh, Eigen::Scaling(3.0)).vertices[2], Vec3(6, 0, 0));
}

TEST(TurnedOver, FacesTheOtherWay) {
  const TriangleMesh over = turned_over(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_EQ(normal_of(over, over.triangles[t]), -normal_of(mesh, mesh.triangles[t]));
}

TEST(PartOf, NumbersVerticesInTheOrderOfTheirUse) {
  const std::vector<std::uint32_t> some = {2, 0};
  const TriangleMesh part = part_of(mesh, some);
  EXPECT_EQ(part.vertices, (std::vector<Vec3>{{0, 0, 4}, {2, 0, 0}, {0, 0, 0}, {0, 3, 0}}));
  EXPECT_EQ(part.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
}

TEST(Box, GrowsWithItsPoints) {
  Box box = bounding_box(mesh);
  EXPECT_EQ(box.lo, Vec3(0, 0, 0));
  EXPECT_EQ(box.extent(), Vec3(9, 9, 9));
  EXPECT_EQ(box.centre(), Vec3(4.5, 4.5, 4.5));
  const Box before = box;
  box.add({-1, 3, 10});
  EXPECT_EQ(box.lo, Vec3(-1, 0, 0));
  EXPECT_EQ(box.hi, Vec3(9, 9, 10));
  EXPECT_TRUE(before.within(box));
  EXPECT_FALSE(box.within(before));
  const auto plane = bounding_box(std::vector<Eigen::Vector2d>{{1, 2}, {-1, 5}});
  EXPECT_EQ(plane.extent(), Eigen::Vector2d(2, 3));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
