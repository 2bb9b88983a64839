// unite_test.cpp - solids that overlap become one: exact volumes, and winding numbers summed over solid
// angles.
#include "mesh/solid/unite.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "body/models/geodesic.hpp"
#include "geometry/moved.hpp"
#include "geometry/single_precision.hpp"
#include "geometry/triangle.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/arrange.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "mesh/solid/solid.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const TriangleMesh cube = box_mesh({0, 0, 0}, {3, 3, 3});

void expect_sound(const TriangleMesh& mesh) {
  const MeshReport report = inspect(mesh);
  EXPECT_TRUE(report.watertight());
  EXPECT_TRUE(report.oriented());
  EXPECT_TRUE(self_intersections(mesh).empty());
}

/// The coordinates are whole multiples of small powers of two, so nothing is rounded.
void expect_united(const TriangleMesh& mesh, double volume, double overlap) {
  const auto united = unite(mesh, InsideOut::refused);
  ASSERT_TRUE(united);
  expect_sound(united->mesh);
  EXPECT_NEAR(inspect(united->mesh).volume, volume, 1e-12 * volume);
  EXPECT_NEAR(united->overlap, overlap, 1e-12 * volume);
  EXPECT_EQ(united->inside_out, 0);
}

TEST(Unite, BoxesThatCross) { expect_united(both(cube, box_mesh({1, 1, 2}, {2, 2, 4})), 28, 1); }

TEST(Unite, BoxesThatPassThroughEachOther) {
  expect_united(both(cube, box_mesh({1, 1, -1}, {2, 2, 4})), 29, 3);
  expect_united(both(both(box_mesh({-5, -1, -1}, {5, 1, 1}), box_mesh({-1, -5, -1}, {1, 5, 1})),
                     box_mesh({-1, -1, -5}, {1, 1, 5})),
                3 * 40 - 2 * 8, 8 + 8);  // the middle counts three times
}

TEST(Unite, FacesInOnePlaneThatOverlap) {
  expect_united(both(cube, box_mesh({1, 0, 0}, {4, 3, 3})), 36, 18);
  expect_united(both(cube, box_mesh({1, 1, 0}, {4, 4, 3})), 42, 12);
  expect_united(both(cube, box_mesh({1, 1, 2}, {2, 2, 3})), 27, 1);
  expect_united(both(cube, box_mesh({0.5, 0.25, 2}, {1.75, 2, 3.5})), 27 + 1.25 * 1.75 * 0.5, 1.25 * 1.75);
}

TEST(Unite, FacesThatTouchFromBothSidesVanish) {
  expect_united(both(cube, box_mesh({3, 0, 0}, {4, 3, 3})), 36, 0);
  expect_united(both(cube, box_mesh({3, 1, 1}, {4, 2, 2})), 28, 0);
  expect_united(both(cube, box_mesh({3, 2, 2}, {4, 5, 5})), 36, 0);
}

TEST(Unite, ShellsThatAreTheSame) {
  expect_united(both(cube, cube), 27, 27);
  expect_united(both(both(cube, cube), cube), 27, 54);
  const TriangleMesh ball = geodesic_sphere(6);
  const double volume = inspect(ball).volume;
  const auto united = unite(both(ball, ball), InsideOut::refused);
  ASSERT_TRUE(united);
  EXPECT_NEAR(inspect(united->mesh).volume, volume, 1e-12);
  EXPECT_EQ(united->kept, united->mesh.triangles.size());
}

TEST(Unite, AShellWithinAnother) {
  expect_united(both(cube, box_mesh({1, 1, 1}, {2, 2, 2})), 27, 1);
  expect_united(both(cube, inverted(box_mesh({1, 1, 1}, {2, 2, 2}))), 26, 0);  // a cavity stays
}

TEST(Unite, ACavityThatReachesOutOfItsSolidIsToldAsInsideOut) {
  const TriangleMesh mesh = both(cube, inverted(box_mesh({1, 1, 2}, {2, 2, 5})));
  const auto as_void = unite(mesh, InsideOut::empty), as_solid = unite(mesh, InsideOut::solid);
  ASSERT_TRUE(as_void && as_solid);
  EXPECT_NEAR(as_void->inside_out, 2, 1e-12);
  EXPECT_NEAR(inspect(as_void->mesh).volume, 26, 1e-12);
  EXPECT_NEAR(inspect(as_solid->mesh).volume, 28, 1e-12);
  expect_sound(as_void->mesh);
  expect_refusal([&] { (void)make_solid(mesh, "part"); }, "part: ", {"2 mm^3", "inside out", "--inside-out"});
  EXPECT_NEAR(inspect(make_solid(mesh, "part", {.inside_out = InsideOut::solid}).mesh).volume, 28, 1e-12);
}

TEST(Unite, ASurfaceThatIsInsideOutEverywhereIsTurned) {
  const auto united = unite(inverted(both(cube, box_mesh({1, 1, 2}, {2, 2, 4}))), InsideOut::refused);
  ASSERT_TRUE(united);
  EXPECT_TRUE(united->turned);
  EXPECT_NEAR(inspect(united->mesh).volume, 28, 1e-12);
}

TEST(Unite, TrianglesThatMeetNoOtherStayBitForBit) {
  TriangleMesh ball = geodesic_sphere(12);
  for (Vec3& v : ball.vertices) v = v / 3 + Vec3(0.1, 0.2, 0.3);
  const TriangleMesh mesh = both(ball, moved(ball, Eigen::Translation3d(0.11, 0.13, 0.17)));
  const auto united = unite(mesh, InsideOut::refused);
  ASSERT_TRUE(united);
  expect_sound(united->mesh);
  std::size_t cut = 0;
  std::vector<bool> meets(mesh.triangles.size());
  for (const auto& [s, t] : self_intersections(mesh)) meets[s] = meets[t] = true;
  for (const bool m : meets) cut += m;
  std::size_t kept = 0, outside = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 middle = middle_of(mesh, mesh.triangles[t]);
    const Vec3 other = t < ball.triangles.size() ? Vec3(0.21, 0.33, 0.47) : Vec3(0.1, 0.2, 0.3);
    outside += !meets[t] && (middle - other).norm() > 1.0 / 3;
  }
  kept = united->kept;
  EXPECT_GT(cut, 20u);
  EXPECT_GE(kept, outside);
}

/// Of the surface about a place: solid angles over 4 pi [Van Oosterom & Strackee 1983].
double winding_at(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    const double x = a.norm(), y = b.norm(), z = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
  }
  return sum / (2 * std::numbers::pi);
}

TriangleMesh turned(const TriangleMesh& mesh, Random& random, double away) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = random_rotation(random);
  pose.translation() = random_vec(random, -away, away);
  return moved(mesh, pose);
}

TEST(Unite, IsSolidWhereverTheSurfaceWindsOnceOrMore) {
  Random random(7);
  for (int repeat = 0; repeat < 12; ++repeat) {
    TriangleMesh mesh;
    for (int i = 0; i < 4; ++i)
      mesh = both(mesh, turned(i % 2 ? torus(12, 7) : box_mesh({-2, -3, -1}, {2, 3, 1}), random, 3));
    const auto united = unite(mesh, InsideOut::refused);
    ASSERT_TRUE(united);
    expect_sound(united->mesh);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = random_vec(random, -5, 5);
      const double before = winding_at(mesh, p), after = winding_at(united->mesh, p);
      EXPECT_NEAR(after, before > 0.5 ? 1 : 0, 1e-6) << repeat << ": " << p.transpose();
    }
  }
}

TEST(Unite, AShellThatRunsThroughItself) {
  // A tube so thick that it meets itself over the ring's hole: its surface winds twice there.
  TriangleMesh mesh = torus(12, 16);
  for (Vec3& v : mesh.vertices) {
    const double around = std::atan2(v.y(), v.x()), out = std::hypot(v.x(), v.y()) - 3;
    v = {(2.5 * out + 1.5) * std::cos(around), (2.5 * out + 1.5) * std::sin(around), 2.5 * v.z()};
  }
  ASSERT_FALSE(self_intersections(mesh).empty());
  Random random(3);
  for (const InsideOut way : {InsideOut::solid, InsideOut::empty}) {
    const auto united = unite(mesh, way);
    ASSERT_TRUE(united);
    expect_sound(united->mesh);
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = random_vec(random, -4, 4);
      const double before = winding_at(mesh, p);
      const bool solid = before > 0.5 || (before < -0.5 && way == InsideOut::solid);
      EXPECT_NEAR(winding_at(united->mesh, p), solid, 1e-6);
    }
  }
}

TEST(Unite, EdgesOfManyTriangles) {
  // Four boxes around one edge: each face at it lies on another's.
  TriangleMesh four;
  for (const double x : {-1, 0})
    for (const double y : {-1, 0}) four = both(four, box_mesh({x, y, 0}, {x + 1, y + 1, 2}));
  EXPECT_NEAR(inspect(make_solid(soup(four), "four").mesh).volume, 8, 1e-12);
  // Two wedges of a third of a turn each share an edge with a box that lies across both.
  const TriangleMesh fan = both(both(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({-1, -1, 0}, {0, 0, 1})),
                                box_mesh({-0.5, -0.5, 0}, {0.5, 0.5, 1}));
  EXPECT_NEAR(inspect(make_solid(soup(fan), "fan").mesh).volume, 2 + 1 - 0.5, 1e-12);
}

TEST(Unite, AnOpenSurfaceHasNoWindingNumbers) {
  TriangleMesh open = both(cube, box_mesh({1, 1, 2}, {2, 2, 4}));
  open.triangles.pop_back();
  EXPECT_FALSE(unite(open, InsideOut::refused));
}

TEST(Unite, CoordinatesOfAnySize) {
  for (const double size : {1e-80, 1e-30, 1e20, 1e90}) {
    TriangleMesh mesh = both(cube, box_mesh({1, 1, 2}, {2, 2, 4}));
    for (Vec3& v : mesh.vertices) v *= size;
    const auto united = unite(mesh, InsideOut::refused);
    ASSERT_TRUE(united);
    expect_sound(united->mesh);
    EXPECT_NEAR(inspect(moved(united->mesh, Eigen::Scaling(1 / size))).volume, 28, 1e-9) << size;
  }
}

TEST(Unite, ATangleIsLeftAlone) {
  Random random(2);
  TriangleMesh tangle;
  for (int i = 0; i < 120; ++i)
    tangle = both(tangle, turned(box_mesh({-9, -0.1, -9}, {9, 0.1, 9}), random, 0.1));
  EXPECT_FALSE(unite(tangle, InsideOut::refused));
}

TEST(Unite, CoordinatesOfSinglePrecisionStayThat) {
  Random random(5);
  TriangleMesh mesh = both(turned(cube, random, 1), turned(cube, random, 1));
  mesh = in_single_precision(mesh);
  const auto united = unite(mesh, InsideOut::refused);
  ASSERT_TRUE(united);
  expect_sound(united->mesh);
  for (const Vec3& v : united->mesh.vertices) EXPECT_EQ(v, in_single_precision(v));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
