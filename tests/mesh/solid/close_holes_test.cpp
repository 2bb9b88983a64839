// close_holes_test.cpp - open surfaces become solids of known volume.
#include "mesh/solid/close_holes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "body/models/geodesic.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/solid.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double any = std::numeric_limits<double>::infinity();

TriangleMesh without(TriangleMesh mesh, const auto& drop) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return drop(mesh, t); });
  return mesh;
}

TEST(CloseHoles, ABoxWithoutALid) {
  const TriangleMesh open =
      without(box_mesh({0, 0, 0}, {2, 3, 5}), [](const TriangleMesh& m, const Triangle& t) {
        return m.vertices[t[0]].z() == 5 && m.vertices[t[1]].z() == 5 && m.vertices[t[2]].z() == 5;
      });
  TriangleMesh mesh = open;
  const ClosedHoles closed = close_holes(mesh, any);
  EXPECT_EQ(closed.count, 1u);
  EXPECT_NEAR(closed.widest, std::hypot(2, 3), 1e-12);
  EXPECT_NEAR(closed.area, 6, 1e-12);
  EXPECT_NEAR(closed.between, 0, 1e-12);
  EXPECT_NEAR(inspect(make_solid(mesh, "box").mesh).volume, 30, 1e-12);
  mesh = open;
  EXPECT_EQ(close_holes(mesh, 3.6).count, 0u);
  expect_refusal([&] { (void)make_solid(open, "box"); }, "box: ", {"open edges: 4"});
}

TEST(CloseHoles, TwoCapsOfASphere) {
  const TriangleMesh ball = geodesic_sphere(16);
  TriangleMesh mesh = without(ball, [](const TriangleMesh& m, const Triangle& t) {
    return std::abs(m.vertices[t[0]].z() + m.vertices[t[1]].z() + m.vertices[t[2]].z()) > 2.7;
  });
  const ClosedHoles closed = close_holes(mesh, any);
  EXPECT_EQ(closed.count, 2u);
  const SolidMesh solid = make_solid(mesh, "ball");
  // A cap of height h = 0.1 has pi h^2 (3 - h) / 3; the rims run along triangles, up and down by their size.
  const double cap = 3.14159 * 0.01 * 2.9 / 3;
  EXPECT_NEAR(inspect(solid.mesh).volume, inspect(ball).volume - 2 * cap, cap);
}

TEST(CloseHoles, ARimThatMeetsItselfIsTwoHoles) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles.erase(mesh.triangles.begin());   // 0 2 3, at the bottom
  std::erase(mesh.triangles, Triangle{0, 1, 5});  // shares the corner 0
  const ClosedHoles closed = close_holes(mesh, any);
  EXPECT_EQ(closed.count, 2u);
  EXPECT_NEAR(inspect(make_solid(mesh, "box").mesh).volume, 1, 1e-12);
}

TEST(CloseHoles, IsAskedForAndTold) {
  Mending mending;
  mending.close_holes = 4;
  TriangleMesh open = box_mesh({0, 0, 0}, {2, 3, 5});
  open.triangles.pop_back();
  Surface surface(open);
  expect_refusal([&] { (void)make_solid(surface, "box", mending); }, "box: ", {"open edges: 3"});
  mending.close_holes = 8;
  const SolidMesh solid = make_solid(surface, "box", mending);
  ASSERT_EQ(solid.repairs.lines.size(), 1u);
  EXPECT_EQ(solid.repairs.lines[0],
            "closed 1 hole, up to 5.831 mm across, by 7.5 mm^2 of patches; 0 mm^3 lie between them and a fan "
            "about the middle of each rim");
}

TEST(CloseHoles, ALongRimTakesItsOutline) {
  TriangleMesh mesh = torus(400, 6);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    double top = 0;
    for (const std::uint32_t v : t) top += mesh.vertices[v].z();
    return top / 3 > 0.8;
  });
  const ClosedHoles closed = close_holes(mesh, any);
  EXPECT_EQ(closed.count, 2u);
  EXPECT_TRUE(inspect(mesh).watertight());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
