// rest_afloat_test.cpp - where floating bodies come to rest, against closed forms of a box and of a ball.
#include "physics/rest_afloat.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/hydrostatics.hpp"
#include "body/models/geodesic.hpp"
#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double length = 10, width = 4, draft = 1.5, bm = width * width / (12 * draft);
const TriangleMesh barge = box_mesh({-length / 2, -width / 2, 0}, {length / 2, width / 2, 3});

RestAfloat rest_of(const Vec3& centre) { return rest_afloat({barge, centre, length * width * draft}); }

/// About x, so that y goes under.
double heel_of(const RestAfloat& rest) { return std::atan2(rest.up[1], rest.up[2]); }

TEST(RestAfloat, WhatIsBalancedStays) {
  const RestAfloat rest = rest_of({0, 0, 1});
  EXPECT_NEAR(rest.up[2], 1, 1e-15);
  EXPECT_FALSE(rest.floods || rest.sinks);
}

TEST(RestAfloat, AWeightToTheSideHeelsABoxAsWallSidesTell) {
  // While deck and bottom stay out of the waterline: sin h (GM + BM tan^2 h / 2) = d cos h.
  constexpr double z = 1.2, gm = draft / 2 + bm - z;
  for (const double d : {-0.1, 0.05, 0.15}) {
    const RestAfloat rest = rest_of({0, d, z});
    const double h = -heel_of(rest);
    EXPECT_NEAR(std::sin(h) * (gm + bm * std::pow(std::tan(h), 2) / 2), d * std::cos(h), 1e-7) << d;
    EXPECT_LT(std::abs(h), std::atan(2 * draft / width)) << "the deck is dry";
    EXPECT_NEAR(rest.up[0], 0, 1e-9);
  }
}

TEST(RestAfloat, AWeightToTheSideAndTheEndHeelsAndTrims) {
  const RestAfloat rest = rest_of({0.4, 0.05, 1});
  // Nothing turns it any more: it is lifted right below its centre of mass.
  Eigen::Matrix3d turn;
  turn.row(2) = rest.up;
  turn.row(0) = rest.up.unitOrthogonal();
  turn.row(1) = rest.up.cross(Vec3(turn.row(0)));
  TriangleMesh turned = barge;
  for (Vec3& v : turned.vertices) v = turn * (v - Vec3(0.4, 0.05, 1));
  const Hydrostatics water = hydrostatics(turned, waterline_of(turned, length * width * draft).value());
  EXPECT_LT(water.centre_of_buoyancy.head<2>().norm(), 1e-7);
  EXPECT_LT(rest.up[0], -1e-3);
  EXPECT_LT(rest.up[1], -1e-3);
}

TEST(RestAfloat, TooHighAWeightMakesABoxLoll) {
  // GM + BM tan^2 h / 2 = 0, to either side.
  constexpr double z = 1.75, gm = draft / 2 + bm - z;
  ASSERT_LT(gm, 0);
  const double h = std::atan(std::sqrt(-2 * gm / bm));
  EXPECT_NEAR(std::abs(heel_of(rest_of({0, 0, z}))), h, 1e-6);
}

TEST(RestAfloat, ABallTurnsItsCentreOfMassDown) {
  TriangleMesh ball = geodesic_sphere(12);
  for (const Vec3& way : {Vec3(0, 0, 1), Vec3(1, 0, 0.2), Vec3(-0.3, 0.4, 0.9)}) {
    const RestAfloat rest = rest_afloat({ball, 0.2 * way.normalized(), 2});
    // Facets of 5 degrees: the centre of buoyancy strays by their sagitta.
    EXPECT_LT((rest.up + way.normalized()).norm(), 0.02) << way.transpose();
  }
}

TEST(RestAfloat, AnOpenBoxThatLeansTooFarTakesWaterAndSinks) {
  // Walls and floor of 0.2, of a heavier material than water: afloat by the air within.
  TriangleMesh hull = barge;
  const TriangleMesh hollow = box_mesh({-4.8, -1.8, 0.2}, {4.8, 1.8, 3});
  const Triangle deck[] = {hull.triangles[2], hull.triangles[3]};
  std::erase_if(hull.triangles, [&](const Triangle& t) { return t == deck[0] || t == deck[1]; });
  for (const Triangle& t : hollow.triangles)
    if (t != deck[0] && t != deck[1]) hull.triangles.push_back({t[0] + 8, t[2] + 8, t[1] + 8});
  hull.vertices.insert(hull.vertices.end(), hollow.vertices.begin(), hollow.vertices.end());
  for (const auto& [a, b] : {std::pair{4u, 5u}, {5u, 7u}, {7u, 6u}, {6u, 4u}}) {  // the rim
    hull.triangles.push_back({a, b, b + 8});
    hull.triangles.push_back({a, b + 8, a + 8});
  }
  const double volume = length * width * 2;
  ASSERT_GT(most_displaced(hull), volume);
  EXPECT_NEAR(rest_afloat({hull, Vec3(0, 0, 1), volume}).up[2], 1, 1e-12);
  const RestAfloat over = rest_afloat({hull, Vec3(0, 0.9, 1), volume});
  EXPECT_TRUE(over.sinks) << "its material is heavier than what it displaces then";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
