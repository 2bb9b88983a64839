#include "fabricate/mould.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/mesh_moments.hpp"
#include "body/models/geodesic.hpp"
#include "error.hpp"
#include "fabricate/lay_flat.hpp"
#include "fabricate/poured.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/components.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double pi = std::numbers::pi;

TriangleMesh scaled(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v = v.cwiseProduct(by);
  return mesh;
}

double volume(const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value[S1]; }

void expect_solid(const TriangleMesh& mesh, const std::string& name) {
  EXPECT_NO_THROW(require_solid(mesh, name)) << name;
  EXPECT_TRUE(self_intersections(mesh).empty()) << name;
  EXPECT_EQ(shells(mesh).size(), 1u) << name;
}

/// Two balls on a lying bar: from any side but the ends' the metal rises in two humps.
TriangleMesh dumbbell() {
  const TriangleMesh bar = box_mesh({-12, -2, -2}, {12, 2, 2});
  std::vector<Channel> none;
  // Balls as castings of their own, joined by marching over all three: what counts is the shape.
  TriangleMesh mesh = both(
      both(moved(scaled(geodesic_sphere(16), Vec3::Constant(6)), Eigen::Matrix3d::Identity(), {-12, 0, 0}),
           moved(scaled(geodesic_sphere(16), Vec3::Constant(6)), Eigen::Matrix3d::Identity(), {12, 0, 0})),
      bar);
  return poured(mesh, none, 0.5);
}

TEST(Poured, OfABallIsTheBall) {
  const double radius = 10, cell = 0.5;
  const TriangleMesh ball = scaled(geodesic_sphere(60), Vec3::Constant(radius)),
                     mesh = poured(ball, {}, cell);
  expect_solid(mesh, "ball");
  // A chord over an edge of a tetrahedron, a cell at most, lies cell^2 / 8R below the ball.
  EXPECT_NEAR(volume(mesh), volume(ball), 4 * pi * radius * radius * cell * cell / (8 * radius));
  for (const Vec3& v : mesh.vertices) EXPECT_NEAR(v.norm(), radius, 2e-3 * cell + radius * 3e-4);
}

TEST(Poured, OfABallAndAChannelIsTheirUnion) {
  const double radius = 10, r = 2, top = 16;
  const TriangleMesh ball = scaled(geodesic_sphere(60), Vec3::Constant(radius));
  const TriangleMesh mesh = poured(ball, {{{0, 0, 8}, r, top}}, 0.25);
  expect_solid(mesh, "ball with a sprue");
  // Of the cylinder what is outside the ball: up from the ball's surface.
  const double under = 2 * pi / 3 * (std::pow(radius, 3) - std::pow(radius * radius - r * r, 1.5));
  EXPECT_NEAR(volume(mesh) - volume(poured(ball, {}, 0.25)), pi * r * r * top - under,
              0.02 * pi * r * r * (top - radius));
}

TEST(Mould, OfABallIsTwoHalvesThatHoldNothingBack) {
  const TriangleMesh ball = scaled(geodesic_sphere(40), Vec3::Constant(10));
  const Mould mould = mould_of(ball);
  EXPECT_EQ(mould.parting.undercut, 0);
  EXPECT_EQ(mould.vents, 0u);
  ASSERT_EQ(mould.parts.size(), 4u) << "halves and two pins";
  EXPECT_EQ(mould.parts[0].name, "upper");
  EXPECT_EQ(mould.parts[1].name, "lower");
  for (const MaterialPart& part : mould.parts) expect_solid(part.surfaces.front(), part.name);
  EXPECT_NEAR(mould.casting, volume(ball), 1e-9 * volume(ball));
  EXPECT_NEAR(mould.cavity, volume(ball), 1e-3 * volume(ball));
  // The sprue from the ball's top, whose dome it takes a part of, to the top face.
  const Vec3 block = bounding_box(both(mould.parts[0].surfaces[0], mould.parts[1].surfaces[0])).extent();
  const double r = mould.sprue_radius, above = block[2] - 20 - 7.5;  // below is the wall
  const double sprue = pi * r * r * above, dome = pi * r * r * r * r / (4 * 10);
  EXPECT_NEAR(mould.metal - mould.cavity, sprue + dome, 0.03 * sprue);
}

TEST(Mould, LiesOnItsFlatSidesWithTheCavityUp) {
  const Mould mould = mould_of(scaled(geodesic_sphere(24), {10, 8, 6}));
  for (const std::size_t half : {0, 1}) {
    const TriangleMesh laid = laid_surfaces(mould.parts[half]).front();
    const Box box = bounding_box(laid);
    EXPECT_EQ(box.lo[2], 0);
    // The floor is the block's flat side, with the mouth of the sprue in it at most; the cut has the cavity.
    double floor = 0, cut = 0;
    for (const Triangle& t : laid.triangles) {
      const Vec3 &a = laid.vertices[t[0]], &b = laid.vertices[t[1]], &c = laid.vertices[t[2]];
      const double area = (b - a).cross(c - a)[2] / 2;
      if (std::max({a[2], b[2], c[2]}) < 1e-4) floor -= area;
      if (std::min({a[2], b[2], c[2]}) > box.hi[2] - 1e-4) cut += area;
    }
    const double side = box.extent()[0] * box.extent()[1];
    EXPECT_NEAR(floor, side - (half == 0 ? pi * std::pow(mould.sprue_radius, 2) : 0), 0.02 * side);
    EXPECT_LT(cut, 0.8 * side);
  }
}

TEST(Mould, HasAVentWhereAirWouldStay) {
  const Mould mould = mould_of(dumbbell());
  EXPECT_EQ(mould.vents, 1u);
  EXPECT_LT(mould.parting.undercut, 0.01 * mould.casting);
  for (const MaterialPart& part : mould.parts) expect_solid(part.surfaces.front(), part.name);
}

TEST(Mould, OfWhatHooksSaysHowMuchItHoldsBack) {
  // Two rings across each other: whichever way the halves are drawn, one of them has the mould through it.
  const TriangleMesh ring = scaled(upright_torus_mesh(3, 0.6, 64, 24), Vec3::Constant(4));
  const TriangleMesh cage = poured(
      both(ring, moved(ring, Eigen::AngleAxisd(pi / 2, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero())), {},
      0.4);
  const Mould mould = mould_of(cage);
  EXPECT_GT(mould.parting.undercut, 0.05 * mould.casting);
  for (const MaterialPart& part : mould.parts) expect_solid(part.surfaces.front(), part.name);
}

TEST(Castings, AreTheShellsOfAPart) {
  const MaterialPart two = {
      "interior", 8.1, {both(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({2, 0, 0}, {4, 2, 2}))}};
  const std::vector<TriangleMesh> castings = castings_of(two, 0.5);
  ASSERT_EQ(castings.size(), 2u);
  EXPECT_NEAR(volume(castings[0]), 1, 1e-12);
  EXPECT_NEAR(volume(castings[1]), 8, 1e-12);
  EXPECT_EQ(castings_of(two, 2).size(), 1u) << "a drop";
}

TEST(Castings, WithAVoidInsideAreRefused) {
  const MaterialPart hollow = {
      "interior", 8.1, {box_mesh({0, 0, 0}, {3, 3, 3}), inverted(box_mesh({1, 1, 1}, {2, 2, 2}))}};
  try {
    (void)castings_of(hollow, 0.5);
    FAIL() << "two halves cannot leave it free";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the interior encloses a void of 1 mm^3"), std::string::npos)
        << error.what();
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
