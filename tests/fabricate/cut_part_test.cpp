#include "fabricate/cut_part.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>

#include "body/mesh_moments.hpp"
#include "error.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A box with a box-shaped cavity in it, turned.
MaterialPart hollow_box(const Eigen::Matrix3d& turn) {
  return {"part",
          2,
          {moved(box_mesh({-2, -3, -4}, {2, 3, 4}), turn, Vec3::Zero()),
           moved(inverted(box_mesh({-1, -2, -3}, {1, 2, 3})), turn, Vec3::Zero())}};
}

Moments moments(const MaterialPart& part) {
  Moments s = Moments::Zero();
  for (const TriangleMesh& mesh : part.surfaces) s += reference::mesh_moments(mesh).value;
  return s;
}

TEST(CutPart, MakesTwoSolidHalvesThatAddUpToThePart) {
  Random random(7);
  for (const double offset : {0.0, 0.7, -2.4, 2.5}) {
    const Eigen::Matrix3d turn = random_rotation(random);
    const MaterialPart part = hollow_box(turn);
    const Plane plane{3 * turn.col(2), 3 * offset};  // a normal of any length
    const std::vector<MaterialPart> halves = cut_part(part, std::vector{plane});
    ASSERT_EQ(halves.size(), 2u);
    EXPECT_EQ(halves[0].name, "upper");
    EXPECT_EQ(halves[1].name, "lower");
    for (const MaterialPart& half : halves) {
      EXPECT_EQ(half.density, 2);
      ASSERT_EQ(half.surfaces.size(), 1u);
      EXPECT_NO_THROW(require_solid(half.surfaces[0], half.name));
      EXPECT_TRUE(self_intersections(half.surfaces[0]).empty());
    }
    // Corners are rounded to single precision: 3e-7 of coordinates up to 5.4, areas up to 2 * 52 + 2 * 22.
    EXPECT_LT((moments(halves[0]) + moments(halves[1]) - moments(part)).cwiseAbs().maxCoeff(), 1e-2);
    EXPECT_NEAR(moments(halves[0])[S1] + moments(halves[1])[S1], moments(part)[S1], 148 * 3.2e-7);
    // The section is a frame of 4 x 6 less 2 x 4; the plane may move by a thousandth of the size.
    const double above = 24 * (4 - offset) - 8 * (3 - offset);
    EXPECT_NEAR(moments(halves[0])[S1], above, 16 * 1e-3 * 10.8);
  }
}

TEST(CutPart, MakesPiecesOfSeveralPlanes) {
  const MaterialPart part = hollow_box(Eigen::Matrix3d::Identity());
  const std::vector<MaterialPart> pieces =
      cut_part(part, std::vector{Plane{Vec3::UnitZ(), 0.1}, Plane{Vec3::UnitX(), 0.1}});
  ASSERT_EQ(pieces.size(), 4u);
  double sum = 0;
  for (const MaterialPart& piece : pieces) {
    EXPECT_NO_THROW(require_solid(piece.surfaces[0], piece.name));
    sum += moments(piece)[S1];
  }
  EXPECT_NEAR(sum, moments(part)[S1], 1e-4);
  EXPECT_EQ(pieces[3].name, "piece-4");
}

TEST(CutPart, AlignsHalvesByPegs) {
  Random random(8);
  const Eigen::Matrix3d turn = random_rotation(random);
  const MaterialPart part = hollow_box(turn);
  const Pegs pegs{0.2};
  const std::vector<MaterialPart> parts = cut_part(part, std::vector{Plane{turn.col(2), 0.4}}, pegs);
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[2].name, "peg-1");
  double sum = 0;
  for (const MaterialPart& each : parts) {
    EXPECT_NO_THROW(require_solid(each.surfaces[0], each.name));
    EXPECT_TRUE(self_intersections(each.surfaces[0]).empty());
    sum += moments(each)[S1];
  }
  // A 24-sided prism: four holes, of which the two pins leave a little.
  const double area = 12 * std::sin(2 * std::numbers::pi / 24);
  const double holes = 4 * area * 0.2 * 0.2 * 0.4, pins = 2 * area * 0.1 * 0.1 * 0.6;
  EXPECT_NEAR(sum, moments(part)[S1] - holes + pins, 1e-4);
  EXPECT_NEAR(moments(parts[2])[S1], pins / 2, 1e-12);
  // The section is a frame, one wide, whose opposite corners are 5.8 apart from middle to middle.
  EXPECT_GT((centre_of_mass(moments(parts[2])) - centre_of_mass(moments(parts[3]))).norm(), 5);
}

TEST(CutPart, RefusesPegsThatHaveNoRoom) {
  const MaterialPart part = hollow_box(Eigen::Matrix3d::Identity());
  const std::vector<Plane> two = {Plane{Vec3::UnitZ(), 0.1}, Plane{Vec3::UnitX(), 0.1}};
  EXPECT_THROW((void)cut_part(part, std::span(two).first(1), Pegs{0.4}), InputError);
  EXPECT_THROW((void)cut_part(part, two, Pegs{0.3}), InputError);
}

TEST(CutPart, RefusesAPlaneThatMisses) {
  EXPECT_THROW(
      (void)cut_part(hollow_box(Eigen::Matrix3d::Identity()), std::vector{Plane{Vec3::UnitZ(), 4.5}}),
      InputError);
}

TEST(CutInHalves, LeavesEachHalfItsOwnVoid) {
  Random random(9);
  const Eigen::Matrix3d turn = random_rotation(random);
  const auto box = [&](const Vec3& lo, const Vec3& hi) {
    return moved(box_mesh(lo, hi), turn, Vec3::Zero());
  };
  const double at = 0.4;
  // That of the upper half goes on beneath the cut, where it is none of the lower half's business.
  const HalfVoids voids{inverted(box({-1, -1, at - 0.2}, {1, 1, 2})),
                        inverted(box({-0.5, -2, -3}, {0.5, 2, at + 0.1}))};
  const Pegs pegs{0.2};
  const std::vector<MaterialPart> parts =
      cut_in_halves(box({-2, -3, -4}, {2, 3, 4}), voids, {turn.col(2), at}, 2, pegs);
  ASSERT_EQ(parts.size(), 4u);
  for (const MaterialPart& each : parts) {
    EXPECT_NO_THROW(require_solid(each.surfaces[0], each.name));
    EXPECT_TRUE(self_intersections(each.surfaces[0]).empty());
  }
  // A hole is a prism of 24 sides; the plane may move by a thousandth of the size.
  const double hole = 12 * std::sin(std::numbers::pi / 12) * 0.2 * 0.2 * pegs.depth();
  EXPECT_NEAR(moments(parts[0])[S1], 24 * (4 - at) - 4 * (2 - at) - 2 * hole, 20 * 1e-3 * 10.8);
  EXPECT_NEAR(moments(parts[1])[S1], 24 * (4 + at) - 4 * (3 + at) - 2 * hole, 20 * 1e-3 * 10.8);
}

TEST(CutInHalves, RefusesAPlaneThatMisses) {
  const TriangleMesh solid = box_mesh(Vec3::Zero(), Vec3::Ones());
  EXPECT_THROW((void)cut_in_halves(solid, {}, {Vec3::UnitZ(), 2}, 1), InputError);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
