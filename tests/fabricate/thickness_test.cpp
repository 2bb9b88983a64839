#include "fabricate/thickness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "body/models/geodesic.hpp"
#include "geometry/moved.hpp"
#include "mesh/make/prism.hpp"
#include "mesh/make/refine.hpp"
#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(ThinnestMaterial, IsTheWebBetweenTwoVoidsWhereThatIsThinnerThanTheWall) {
  const TriangleMesh outer = box_mesh(Vec3::Zero(), Vec3::Constant(10));
  for (const double web : {0.3, 0.7}) {
    const TriangleMesh voids =
        both(inverted(box_mesh({1, 1, 1}, {5, 9, 9})), inverted(box_mesh({5 + web, 1, 1}, {9, 9, 9})));
    const ThinPlace found = thinnest_material(outer, voids, 0.1);
    EXPECT_NEAR(found.thickness, web, 1e-5) << "single precision of coordinates up to 10";
    EXPECT_TRUE(std::abs(found.at[0] - 5) < 1e-9 || std::abs(found.at[0] - 5 - web) < 1e-9);
  }
}

TEST(ThinnestMaterial, IsTheWallOfASingleVoid) {
  const TriangleMesh outer = box_mesh(Vec3::Zero(), Vec3::Constant(10));
  EXPECT_NEAR(thinnest_material(outer, inverted(box_mesh({1, 2, 0.6}, {9, 8, 8})), 0.1).thickness, 0.6, 1e-5);
}

TEST(ThinnestMaterial, IsRightFarFromTheOrigin) {
  for (const double away : {0.0, 2e3, 2e4, 5e8}) {
    const auto there = [&](TriangleMesh mesh) {
      return moved(std::move(mesh), Eigen::Translation3d(away, -0.7 * away, 0.1 * away));
    };
    const TriangleMesh outer = there(box_mesh(Vec3::Zero(), Vec3::Constant(10)));
    const double found =
        thinnest_material(outer, there(inverted(box_mesh({1, 2, 0.625}, {9, 8, 8}))), 0.1).thickness;
    // Corners and a ray's start are rounded to 6e-8 of themselves at 5e8.
    EXPECT_NEAR(found, 0.625, 1e-9 + 4e-16 * away) << away;
  }
}

/// A void of 8 x 8 x 8 with a wedge of material in it, whose edge lies in its middle, within walls of 2.
ThinPlace next_to_wedge(double opening_degrees) {
  const double w = 4 * std::tan(opening_degrees / 2 * std::numbers::pi / 180);
  const std::vector<Vec2> around = {{-4, -4}, {4, -4}, {4, 4}, {w, 4}, {0, 0}, {-w, 4}, {-4, 4}};
  TriangleMesh cavity = inverted(prism(around, -4, 4));
  split_edges(cavity, [](const Vec3& a, const Vec3& b) { return (a - b).norm() > 0.5; });
  return thinnest_material(box_mesh(Vec3::Constant(-6), Vec3::Constant(6)), cavity, 0.1);
}

TEST(ThinnestMaterial, IsNotTheEdgeOfAWedge) {
  // The base is wider than the walls, and what the refined cavity has for sides is plane.
  for (const double opening : {45.0, 60.0, 75.0}) {
    SCOPED_TRACE(opening);
    const ThinPlace found = next_to_wedge(opening);
    EXPECT_NEAR(found.thickness, 2, 1e-9);
    EXPECT_GE(found.at.cwiseAbs().maxCoeff(), 4 - 1e-9) << "a wall's";
  }
}

TEST(ThinnestMaterial, IsTheBladeThatIsHardlyAWedge) {
  const ThinPlace found = next_to_wedge(10);
  EXPECT_LT(found.thickness, 0.2);
  EXPECT_LT(std::abs(found.at[1]), 0.6) << "near its edge";
}

TEST(ThinnestMaterial, IsOfPlacesThatAPrinterMakes) {
  // A web of 0.2 and 0.5 x 0.5 in area between two voids whose walls are 2 thick.
  const TriangleMesh outer = box_mesh(Vec3::Zero(), Vec3::Constant(10));
  const TriangleMesh voids =
      both(inverted(box_mesh({2, 2, 2}, {5, 8, 8})), inverted(box_mesh({5.2, 4, 4}, {8, 4.5, 4.5})));
  EXPECT_NEAR(thinnest_material(outer, voids, 0.4).thickness, 0.2, 1e-5);
  EXPECT_GE(thinnest_material(outer, voids, 0.6).thickness, 2 - 1e-5);
}

TEST(ThinnestMaterial, IsThePinInsideARing) {
  // A torus of 3 about 1 leaves a pin of 4 across at its narrowest, and walls of 9 and more.
  const TriangleMesh outer = box_mesh(Vec3::Constant(-13), Vec3::Constant(13));
  const ThinPlace found = thinnest_material(outer, inverted(torus(90, 60)), 0.1);
  // A facet at the narrowest, of a 60th of a turn, leans by up to 6 degrees: a way across ends 0.4 higher,
  // where the ring is 1 - cos(0.4) farther on.
  EXPECT_NEAR(found.thickness, 4, 0.08);
  EXPECT_NEAR(found.at.head<2>().norm(), 2, 0.01);
}

TEST(ThinnestMaterial, OfCurvedWallsIsNotThatOfTheirFacets) {
  // Facets of a ball meet at nearly 180 degrees; none of them is thin.
  TriangleMesh outer = geodesic_sphere(24), cavity = inverted(geodesic_sphere(20));
  for (Vec3& v : outer.vertices) v *= 10;
  for (Vec3& v : cavity.vertices) v *= 9;
  const double found = thinnest_material(outer, cavity, 0.1).thickness;
  // Corners of the cavity are 1 deep, its facets more: sagitta of an edge of 9 * 1.2 / 20 is 0.004; that of
  // the outer comes in by 0.005.
  EXPECT_NEAR(found, 1, 0.01);
}

TEST(ThinnestMaterial, IsInfiniteWithoutACavity) {
  EXPECT_TRUE(std::isinf(thinnest_material(box_mesh(Vec3::Zero(), Vec3::Ones()), {}, 0.1).thickness));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
