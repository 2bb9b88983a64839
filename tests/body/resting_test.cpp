#include "body/resting.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body/support_polygon.hpp"
#include "domain/test_bodies.hpp"
#include "geometry/rotation.hpp"

namespace kreisel::core {
namespace THIS_FILE {

constexpr double round_off = 1e-12;

double total(const std::vector<RestingPose>& poses) {
  double sum = 0;
  for (const RestingPose& pose : poses) sum += pose.probability;
  return sum;
}

TEST(RestingPoses, OfABoxAreItsFacesWithTheSolidAnglesOfThem) {
  const Vec3 half(1, 2, 3);
  const ConvexHull hull = convex_hull(box_mesh(-half, half).vertices);
  const auto poses = resting_poses(hull, Vec3::Zero());
  ASSERT_EQ(poses.size(), 6u);
  EXPECT_NEAR(total(poses), 1, round_off);
  for (const RestingPose& pose : poses) {
    EXPECT_TRUE(pose.stable());
    Eigen::Index axis = 0;
    EXPECT_NEAR(pose.up.cwiseAbs().maxCoeff(&axis), 1, round_off);
    // A rectangle 2a x 2b at distance d covers 4 atan(ab / (d sqrt(a^2 + b^2 + d^2))).
    const double d = half[axis], a = half[(axis + 1) % 3], b = half[(axis + 2) % 3];
    EXPECT_NEAR(pose.probability, std::atan(a * b / (d * half.norm())) / std::numbers::pi, round_off);
    EXPECT_NEAR(pose.area, 4 * a * b, round_off);
  }
  EXPECT_EQ(poses[0].up.cwiseAbs()[0], 1) << "the widest faces, across x, first";
}

TEST(RestingPoses, OfATopHeavyPostAreThoseItDoesNotFallFrom) {
  // Centre of mass above the corner of a wedge's foot: it rolls on from there.
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 4});
  TriangleMesh leaning = box;
  for (Vec3& v : leaning.vertices)
    if (v[2] > 1) v[0] += 3;  // the centre, at x = 0.5 + 1.5, is over no part of its foot
  const ConvexHull hull = convex_hull(leaning.vertices);
  const auto poses = resting_poses(hull, {2, 0.5, 2});
  EXPECT_NEAR(total(poses), 1, round_off);
  for (const RestingPose& pose : poses) {
    if (std::abs(pose.up[2]) > 0.99) {
      EXPECT_FALSE(pose.stable());
      EXPECT_EQ(pose.probability, 0) << "it rolls on to a side";
    }
  }
  EXPECT_TRUE(poses[0].stable());
}

TEST(RestingPoses, ATetrahedronsSolidAnglesSumToTheSphere) {
  const TriangleMesh t = tetrahedron_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  double sum = 0;
  for (const Triangle& f : t.triangles)
    sum += solid_angle({0.2, 0.2, 0.2}, t.vertices[f[0]], t.vertices[f[1]], t.vertices[f[2]]);
  EXPECT_NEAR(sum, 4 * std::numbers::pi, round_off);
}

TEST(RestingPoses, TheGradientOfASolidAngleMatchesDifferences) {
  const Vec3 a(1, 0.2, 0), b(0.1, 1, 0.3), c(-0.4, 0.2, 1), p(-0.2, -0.1, -0.3);
  const Vec3 gradient = solid_angle_gradient(p, a, b, c);
  constexpr double step = 1e-5;
  for (int k = 0; k < 3; ++k) {
    const Vec3 d = step * Vec3::Unit(k);
    EXPECT_NEAR(gradient[k], (solid_angle(p + d, a, b, c) - solid_angle(p - d, a, b, c)) / (2 * step), 1e-9);
  }
}

/// A box of 40 x 40 x 20 mm about the z-axis, one corner of its bottom lifted.
Body lifted(double mm) {
  TriangleMesh mesh = box_mesh({-1, -1, 0}, {1, 1, 1});
  mesh.vertices[3][2] = mm / 20;
  return body_of(mesh, 20);
}

TEST(RestingPolygon, TakesCornersWithinATenthOfAMillimetre) {
  EXPECT_EQ(resting_polygon(lifted(0)).corners.size(), 4u);
  EXPECT_EQ(resting_polygon(lifted(0.05)).corners.size(), 4u);
  EXPECT_NEAR(resting_polygon(lifted(0.05)).area, 4, 1e-9);
  // Half a millimetre over 40 is 0.7 degrees across one edge and farther across the diagonal.
  EXPECT_EQ(resting_polygon(lifted(0.5)).corners.size(), 3u);
}

TEST(RestingPolygon, IsOfTheNearestFacetWithinHalfADegree) {
  const auto tilted = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    Body body = lifted(0);
    body.frame.rotation = Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix();
    return resting_polygon(body).corners.size();
  };
  EXPECT_EQ(tilted(0.4), 4u);
  EXPECT_EQ(tilted(0.6), 0u) << "it stands on an edge";
}

TriangleMesh ball(int around, double radius) {
  TriangleMesh mesh;  // only its vertices count
  for (const Vec3& p : sphere_directions(around)) mesh.vertices.push_back(radius * p);
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(RestingPolygon, ABallHasNoneHoweverItIsTurnedAndMade) {
  Random random(303);
  for (const int points : {500, 2000, 20'000})
    for (int trial = 0; trial < 10; ++trial) {
      Body body = body_of(ball(points, 0.62), 48);
      // On one of its facets.
      const ConvexHull& hull = body.hull.of(body.mesh.vertices);
      const auto f =
          static_cast<std::size_t>(uniform(random, 0, static_cast<double>(hull.facets.size()) - 1));
      body.frame.rotation = axis_to_z(-hull.normal(f));
      EXPECT_TRUE(resting_polygon(body).corners.empty()) << points;
    }
}

TEST(RestingPolygon, ABallThatIsCutFlatHasOne) {
  TriangleMesh mesh = ball(5000, 0.62);
  for (Vec3& v : mesh.vertices) v[2] = std::max(v[2], -0.5);
  EXPECT_NEAR(resting_polygon(body_of(mesh, 48)).area, std::numbers::pi * (0.62 * 0.62 - 0.25), 0.02);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
