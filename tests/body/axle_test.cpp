#include "body/axle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/body.hpp"
#include "body/mesh_moments.hpp"
#include "body/test_meshes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/components.hpp"
#include "refusal.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Moments moments_of(const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value; }

/// Moments of a prism with the axle's polygon about the z axis, from z0 to z1: of a regular n-gon of
/// circumradius r the area is n/2 r^2 sin(2 pi/n), and its sxx = syy = area r^2 (2 + cos(2 pi/n)) / 12.
Moments prism(double r, double z0, double z1) {
  constexpr double angle = 2 * std::numbers::pi / 48;
  const double area = 24 * r * r * std::sin(angle), around = area * r * r * (2 + std::cos(angle)) / 12;
  Moments s = Moments::Zero();
  s[S1] = area * (z1 - z0);
  s[SZ] = area * (z1 * z1 - z0 * z0) / 2;
  s[SZZ] = area * (z1 * z1 * z1 - z0 * z0 * z0) / 3;
  s[SXX] = s[SYY] = around * (z1 - z0);
  return s;
}

TEST(Axle, PartsABoxIntoTwoHalvesWithHolesForIt) {
  const TriangleMesh box = box_mesh({-10, -8, -12}, {10, 8, 12});
  const Axle axle{2, 3, 5};
  const TriangleMesh both = halves(box, axle);
  require_solid(both, "both");
  EXPECT_EQ(shells(both).size(), 2u);
  const Moments want = box_moments({0, 0, 6.75}, {20, 16, 10.5}) +
                       box_moments({0, 0, -6.75}, {20, 16, 10.5}) - prism(2, 1.5, 6.5) - prism(2, -6.5, -1.5);
  EXPECT_LE((moments_of(both) - want).cwiseAbs().maxCoeff(), 1e-12 * want.cwiseAbs().maxCoeff());
  const TriangleMesh mesh = axle_mesh(axle);
  require_solid(mesh, "axle");
  EXPECT_LE((moments_of(mesh) - prism(2, -6.5, 6.5)).cwiseAbs().maxCoeff(),
            1e-12 * want.cwiseAbs().maxCoeff());
  for (const bool upper : {true, false}) {
    const TriangleMesh half = half_of(both, upper);
    require_solid(half, "half");
    EXPECT_NEAR(moments_of(half)[S1], want[S1] / 2, 1e-9);
  }
}

TEST(Axle, OfABodyIsFixedAndNotInItsMesh) {
  BodySpec spec;
  spec.model = "cuboid";  // 60 x 40 x 30 mm
  spec.centred = true;
  spec.axle = {.radius = 3, .slot = 2, .depth = 8};
  const Body body = make_body(spec, test_device());
  const double length = body.frame.length, volume = length * length * length;
  const double halves_mm3 = 60.0 * 40 * (30 - 2) - 2 * prism(3, 0, 8)[S1], axle_mm3 = prism(3, -9, 9)[S1];
  EXPECT_NEAR(volume, halves_mm3, 1e-9 * halves_mm3);
  EXPECT_NEAR(body.solid[S1] * volume, halves_mm3 + axle_mm3, 1e-9 * halves_mm3);
  EXPECT_NEAR(body.added[S1] * volume, axle_mm3, 1e-9 * axle_mm3);
  EXPECT_LE(centre_of_mass(body.solid).norm(), 1e-9) << "the axle's centre is that of the whole";
}

TEST(Axle, ThatDoesNotFitIsRefused) {
  const TriangleMesh box = box_mesh({-10, -8, -12}, {10, 8, 12});
  expect_refusal([&] { (void)halves(box, {8, 3, 5}); }, "an axle of radius 8 mm", {"break through"});
  expect_refusal([&] { (void)halves(box, {2, 3, 11}); }, "an axle", {"holes of 11 mm", "break through"});
  EXPECT_EQ(axle_of({}), std::nullopt);
  expect_refusal([] { (void)axle_of({.radius = -1}); }, "axle -1 mm", {});
  expect_refusal([] { (void)axle_of({.radius = 1, .slot = 0}); }, "slot 0 mm", {});
  expect_refusal([] { (void)axle_of({.slot = 2}); }, "a slot or a depth without an axle", {});
  BodySpec spec;
  spec.model = "cuboid";
  spec.axle.radius = 2;
  expect_refusal([&] { (void)make_body(spec, test_device()); }, "--axle 2 mm", {"problem yoyo"});
  spec.model = "woven-ring";  // nothing but air about its axis
  spec.centred = true;
  expect_refusal([&] { (void)make_body(spec, test_device()); }, "a hole in the cut", {"air"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
