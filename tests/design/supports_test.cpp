// supports_test.cpp - what lies below ceilings, by closed forms, and what a slicer puts there.
#include "design/supports.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/moved.hpp"
#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(BelowCeilings, OfAVoidIsAllOfItsBox) {
  const TriangleMesh cavity = turned_over(box_mesh({0, 0, 0}, {10, 20, 30}));
  EXPECT_NEAR(below_ceilings(cavity, Vec3::UnitZ()), 6000, 1e-3);
  EXPECT_NEAR(below_ceilings(cavity, Vec3::UnitX()), 6000, 1e-3);
}

TEST(BelowCeilings, OfASolidBoxOnTheBedIsNothing) {
  EXPECT_EQ(below_ceilings(box_mesh({0, 0, 5}, {10, 20, 30}), Vec3::UnitZ()), 0);
}

/// A roof: a prism with a triangle, half as high as it is wide or more, along y.
TriangleMesh roof(double half_width, double height, double length) {
  TriangleMesh mesh;
  mesh.vertices = {{-half_width, 0, 0},      {half_width, 0, 0},      {0, 0, height},
                   {-half_width, length, 0}, {half_width, length, 0}, {0, length, height}};
  mesh.triangles = {{0, 1, 2}, {5, 4, 3}, {0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}, {2, 5, 3}, {2, 3, 0}};
  return mesh;
}

TEST(BelowCeilings, OfASteepRoofAreNoneAndOfAFlatOneAllOfIt) {
  const TriangleMesh steep = turned_over(roof(5, 6, 40)), flat = turned_over(roof(5, 4, 40));
  EXPECT_EQ(below_ceilings(steep, Vec3::UnitZ()), 0);
  // Straight down from the middle of a triangle, for all of it: exact, as the height is linear.
  EXPECT_NEAR(below_ceilings(flat, Vec3::UnitZ()), 5 * 4 * 40, 1e-3 * 5 * 4 * 40);
}

TEST(VoidSupports, AreNotMeasuredOfACommandThatCannotBeToldTo) {
  const TriangleMesh outer = box_mesh({0, 0, 0}, {10, 10, 10});
  EXPECT_FALSE(measure_supports(MeshSlicer({"sh {model} {gcode}", {}}), outer, {}, Vec3::UnitZ(), {}));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
