#include "body/hydrostatics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/mesh_moments.hpp"
#include "body/test_meshes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using std::numbers::pi;

/// Sums over a few dozen triangles in numbers of order one to a hundred: some hundred roundings.
constexpr double round_off = 512 * 0x1p-53;

/// Upright prism over a regular polygon with its corners at radius r; with a hole when `hole` > 0.
TriangleMesh ring_mesh(std::uint32_t n, double r, double hole, double z0, double z1) {
  TriangleMesh mesh;
  for (const double radius : {r, hole})
    for (const double z : {z0, z1})
      for (std::uint32_t i = 0; i < n; ++i)
        mesh.vertices.emplace_back(radius * std::cos(2 * pi * i / n), radius * std::sin(2 * pi * i / n), z);
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    quad(i, j, n + j, n + i);                          // outside
    quad(2 * n + j, 2 * n + i, 3 * n + i, 3 * n + j);  // of the hole; no area when it has no radius
    quad(i, 2 * n + i, 2 * n + j, j);                  // below
    quad(n + i, n + j, 3 * n + j, 3 * n + i);          // above
  }
  return mesh;
}

/// Area and second moment about a centroidal axis of a regular polygon with corners at radius r.
double polygon_area(int n, double r) { return n / 2.0 * r * r * std::sin(2 * pi / n); }
double polygon_moment(int n, double r) {
  const double side = 2 * r * std::sin(pi / n);
  return polygon_area(n, r) / 24 * (6 * r * r - side * side);
}

TEST(Hydrostatics, OfABoxAreThoseOfABarge) {
  const double length = 3, breadth = 2, z0 = -0.4, draft = 0.7;
  const TriangleMesh box = box_mesh({1, -1, z0}, {1 + length, -1 + breadth, 0.8});
  const Hydrostatics h = hydrostatics(box, z0 + draft);
  EXPECT_EQ(h.waterline, z0 + draft);
  EXPECT_NEAR(h.volume, length * breadth * draft, round_off);
  EXPECT_NEAR((h.centre_of_buoyancy - Vec3(2.5, 0, z0 + draft / 2)).norm(), 0, round_off);
  EXPECT_NEAR(h.waterplane_area, length * breadth, round_off);
  EXPECT_NEAR(h.least_second_moment, length * std::pow(breadth, 3) / 12, round_off);
  // BM = b^3 l / 12 / (b l d) = b^2 / 12 d: half the draft and 4 / 8.4 above the keel.
  EXPECT_NEAR(h.metacentre(), z0 + 0.35 + 4 / 8.4, round_off);
}

TEST(Hydrostatics, OfPrismsAndOfARingWithAHoleInItsSection) {
  for (const std::uint32_t n : {3u, 5u, 8u, 31u})
    for (const double hole : {0.0, 0.6}) {
      const int sides = static_cast<int>(n);
      const Vec3 shift(0.3, -1.2, 2);
      const TriangleMesh ring = moved(ring_mesh(n, 1, hole, 0, 1.5), Eigen::Matrix3d::Identity(), shift);
      const Hydrostatics h = hydrostatics(ring, 2.9);
      const double area = polygon_area(sides, 1) - polygon_area(sides, hole);
      EXPECT_NEAR(h.waterplane_area, area, round_off);
      EXPECT_NEAR(h.volume, 0.9 * area, round_off);
      EXPECT_NEAR((h.centre_of_buoyancy - Vec3(0.3, -1.2, 2.45)).norm(), 0, round_off);
      // The same about every axis, so the smaller eigenvalue is off by the root of what cancels: none here.
      EXPECT_NEAR(h.least_second_moment, polygon_moment(sides, 1) - polygon_moment(sides, hole), round_off);
    }
}

TEST(Hydrostatics, OfTwoHullsCountTheirDistance) {
  // Two floats of 4 x 0.5, 2 apart between centres: across I = 2 (0.5^3 4 / 12 + 2 1^2); along 2 (0.5 4^3 /
  // 12).
  TriangleMesh both = box_mesh({-2, 0.75, 0}, {2, 1.25, 1});
  const TriangleMesh other = box_mesh({-2, -1.25, 0}, {2, -0.75, 1});
  const auto first = static_cast<std::uint32_t>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  const Hydrostatics h = hydrostatics(both, 0.5);
  EXPECT_NEAR(h.volume, 2, round_off);
  EXPECT_NEAR(h.least_second_moment, 2 * (0.125 * 4 / 12 + 2), round_off);
  EXPECT_NEAR(h.metacentre(), 0.25 + (0.25 / 3 + 4) / 2, round_off);
}

/// From the poles to the equator in `rows` rings of 2 rows points each.
TriangleMesh sphere_mesh(int rows) {
  TriangleMesh mesh;
  const int around = 2 * rows;
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < around; ++j) {
      const double u = pi * i / rows - pi / 2, v = pi * j / rows;
      mesh.vertices.emplace_back(std::cos(u) * std::cos(v), std::cos(u) * std::sin(v), std::sin(u));
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * around + j % around); };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < around; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  return mesh;
}

TEST(Hydrostatics, OfASphereApproachTheCapInSecondOrder) {
  for (const double d : {0.5, 1.0, 1.3}) {  // draft, radius 1
    const double volume = pi * d * d * (3 - d) / 3, a2 = d * (2 - d);
    const double cz = -3 * (2 - d) * (2 - d) / (4 * (3 - d));
    double error[2][4];
    for (const int fine : {0, 1}) {
      const Hydrostatics h = hydrostatics(sphere_mesh(fine ? 80 : 40), d - 1);
      error[fine][0] = std::abs(h.volume - volume);
      error[fine][1] = std::abs(h.waterplane_area - pi * a2);
      error[fine][2] = std::abs(h.least_second_moment - pi * a2 * a2 / 4);
      error[fine][3] = std::abs(h.centre_of_buoyancy[2] - cz);
      EXPECT_NEAR(h.centre_of_buoyancy.head<2>().norm(), 0, 100 * round_off) << "25 600 triangles";
      // A chord stays within s^2 / 8 of its arc, s = pi / 40 the longest edge, twice in each direction: over
      // the half sphere's area 2 pi. Moments of the disc scale with the fourth power of its radius.
      const double sagitta = 4 * std::pow(pi / (fine ? 80 : 40), 2) / 8;
      EXPECT_LE(error[fine][0], 2 * pi * sagitta);
      EXPECT_LE(error[fine][1], 2 * pi * sagitta);
      EXPECT_LE(error[fine][2], pi * sagitta);
      // The metacentre of a sphere is its centre.
      EXPECT_NEAR(h.metacentre(), 0, 4 * sagitta);
    }
    for (const int k : {0, 1, 2, 3}) {
      if (error[0][k] < 1e-6) continue;  // hits a ring of vertices, or cancels
      EXPECT_GT(error[0][k] / error[1][k], 2.5) << "quantity " << k << " at " << d << ": 4 in the limit";
    }
  }
}

TEST(Hydrostatics, AtTheLowestPointThereIsNothingAndAtTheHighestEverything) {
  const TriangleMesh box = box_mesh({0, 0, 1}, {2, 3, 2});
  const Hydrostatics none = hydrostatics(box, 1), all = hydrostatics(box, 2), above = hydrostatics(box, 7);
  EXPECT_EQ(none.volume, 0);
  EXPECT_EQ(none.metacentre(), none.centre_of_buoyancy[2]);
  EXPECT_EQ(hydrostatics(box, 0.5).volume, 0);
  EXPECT_EQ(hydrostatics(box, 0.5).waterplane_area, 0);
  EXPECT_NEAR(all.volume, 6, round_off);
  EXPECT_NEAR((all.centre_of_buoyancy - Vec3(1, 1.5, 1.5)).norm(), 0, round_off);
  EXPECT_EQ(all.waterplane_area, 0) << "nothing pierces the surface";
  EXPECT_EQ(all.least_second_moment, 0);
  EXPECT_NEAR(above.volume, 6, 8 * round_off) << "five lengths from the origin of the sums";
  EXPECT_NEAR(all.metacentre(), 1.5, round_off) << "submerged: righted about its centre of buoyancy";
}

TEST(Hydrostatics, AFaceInTheWaterplaneCountsAsUnderWater) {
  const double depth = 2;
  const TriangleMesh c = letter_c_mesh(depth);  // arms z in [0,1] and [2,3], 3 long; back 1 long
  const Hydrostatics lower = hydrostatics(c, 1), upper = hydrostatics(c, 2);
  EXPECT_NEAR(lower.volume, 3 * depth, round_off);
  EXPECT_NEAR((lower.centre_of_buoyancy - Vec3(1.5, 1, 0.5)).norm(), 0, round_off);
  EXPECT_NEAR(lower.waterplane_area, depth, round_off) << "the lower arm's top is wet, the back goes on";
  EXPECT_NEAR(lower.least_second_moment, depth / 12, round_off);
  EXPECT_NEAR(upper.volume, 4 * depth, round_off);
  EXPECT_NEAR(upper.waterplane_area, 3 * depth, round_off) << "the upper arm's bottom is wet";
  EXPECT_NEAR(upper.least_second_moment, 3 * std::pow(depth, 3) / 12, round_off);
  // Volume is continuous there: half an area per unit of height at most three times the depth.
  for (const double z : {1.0, 2.0})
    for (const double e : {1e-9, -1e-9})
      EXPECT_NEAR(hydrostatics(c, z + e).volume, hydrostatics(c, z).volume, 3 * depth * 1e-9 + round_off);
}

/// The part of a convex mesh below a plane as a mesh of its own, face by face and a fan of the section; the
/// section as a prism of height one.
struct Cut {
  TriangleMesh below, section;
};

void add_fan(TriangleMesh& mesh, const std::vector<Vec3>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  for (std::uint32_t k = 2; k < corners.size(); ++k)
    mesh.triangles.push_back({first, first + k - 1, first + k});
}

Cut cut(const TriangleMesh& convex, double waterline) {
  Cut result;
  std::vector<Vec3> rim;
  for (const Triangle& t : convex.triangles) {
    std::vector<Vec3> polygon;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = convex.vertices[t[k]], b = convex.vertices[t[(k + 1) % 3]];
      if (a[2] < waterline) polygon.push_back(a);
      if ((a[2] < waterline) == (b[2] < waterline)) continue;
      polygon.push_back(a + (waterline - a[2]) / (b[2] - a[2]) * (b - a));
      rim.push_back(polygon.back());
    }
    add_fan(result.below, polygon);
  }
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : rim) middle += p / static_cast<double>(rim.size());
  std::ranges::sort(rim, {}, [&](const Vec3& p) { return std::atan2(p[1] - middle[1], p[0] - middle[0]); });
  add_fan(result.below, rim);
  std::vector<Vec3> under(rim.rbegin(), rim.rend());
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const Vec3 &a = rim[k], &b = rim[(k + 1) % rim.size()];
    add_fan(result.section, {a - Vec3::UnitZ(), b - Vec3::UnitZ(), b, a});
  }
  for (Vec3& p : under) p -= Vec3::UnitZ();
  add_fan(result.section, rim);
  add_fan(result.section, under);
  return result;
}

TEST(Hydrostatics, OfBoxesInAnyPositionAgreeWithTheMomentsOfTheCutBox) {
  Random random(72);
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const TriangleMesh box = moved(box_mesh(Vec3::Zero(), random_vec(random, 0.5, 2)),
                                   random_rotation(random), random_vec(random, -2, 2));
    const Box bounds = bounding_box(box);
    const double waterline = bounds.lo[2] + uniform(random, 0.05, 0.95) * bounds.extent()[2];
    const Hydrostatics h = hydrostatics(box, waterline);
    const Cut want = cut(box, waterline);
    // The reference integrates about the origin, up to 5 away, where second moments reach 25 times their
    // size.
    const double tolerance = 100 * round_off;
    const Moments below = reference::mesh_moments(want.below).value;
    EXPECT_NEAR(h.volume, below[S1], tolerance);
    EXPECT_NEAR((h.centre_of_buoyancy - centre_of_mass(below)).norm(), 0, tolerance / below[S1]);
    const Moments section = reference::mesh_moments(want.section).value;
    EXPECT_NEAR(h.waterplane_area, section[S1], tolerance);
    const Eigen::Vector3d c = centre_of_mass(section);
    Eigen::Matrix2d second;
    second << section[SXX] - c[0] * c[0] * section[S1], section[SXY] - c[0] * c[1] * section[S1],
        section[SXY] - c[0] * c[1] * section[S1], section[SYY] - c[1] * c[1] * section[S1];
    EXPECT_NEAR(h.least_second_moment,
                Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(second).eigenvalues()[0], tolerance);
  }
}

/// Heel by a small angle about a horizontal axis at constant displacement: the centre of buoyancy moves
/// across the axis by I / V times the angle, I the waterplane's moment about the axis through its centroid.
double metacentric_radius(const TriangleMesh& mesh, double volume, const Vec3& axis) {
  const double angle = 1e-4;
  Vec3 centre[2];
  for (const int side : {0, 1}) {
    const Eigen::Matrix3d heel = Eigen::AngleAxisd(side ? angle : -angle, axis).toRotationMatrix();
    const TriangleMesh heeled = moved(mesh, heel, Vec3::Zero());
    centre[side] =
        heel.transpose() * hydrostatics(heeled, waterline_of(heeled, volume).value()).centre_of_buoyancy;
  }
  const Vec3 across = Vec3::UnitZ().cross(axis);
  return std::abs((centre[1] - centre[0]).dot(across)) / (2 * angle);
}

TEST(Hydrostatics, TheMetacentreIsTheCentreOfCurvatureOfTheBuoyancyCurve) {
  Random random(73);
  for (int trial = 0; trial < 10; ++trial) {
    const TriangleMesh c = moved(letter_c_mesh(1.3), random_rotation(random), Vec3::Zero());
    const double volume = uniform(random, 0.2, 0.8) * 7 * 1.3;
    const Hydrostatics h = hydrostatics(c, waterline_of(c, volume).value());
    const double xx = metacentric_radius(c, volume, Vec3::UnitX());
    const double yy = metacentric_radius(c, volume, Vec3::UnitY());
    const double both = metacentric_radius(c, volume, Vec3(1, 1, 0).normalized());
    const double xy = both - (xx + yy) / 2;
    const double least = (xx + yy) / 2 - std::hypot((xx - yy) / 2, xy);
    // Central differences: 1e-8 of what the third derivative makes of a section with slanting sides, and
    // round-off 1e-14 / 1e-4.
    EXPECT_NEAR(h.least_second_moment / h.volume, least, 1e-6) << "trial " << trial;
    EXPECT_NEAR(h.metacentre() - h.centre_of_buoyancy[2], least, 1e-6);
  }
}

TEST(WaterlineOf, IsTheInverseOfTheDisplacedVolume) {
  Random random(74);
  for (int trial = 0; trial < 20; ++trial) {
    const TriangleMesh c = moved(letter_c_mesh(1.3), random_rotation(random), random_vec(random, -3, 3));
    const double whole = reference::mesh_moments(c).value[S1], wanted = uniform(random, 0, whole);
    // A waterline is good to a rounding of its own, times the section's area, at most 4.3 x 1.3 x 2.
    EXPECT_NEAR(hydrostatics(c, waterline_of(c, wanted).value()).volume, wanted, 12 * round_off);
    // A tip's volume is cubic in its depth, so round-off of a volume is some cube root of it in depth.
    const Box box = bounding_box(c);
    EXPECT_NEAR(waterline_of(c, 0).value(), box.lo[2], std::cbrt(round_off));
    EXPECT_NEAR(waterline_of(c, whole).value(), box.hi[2], std::cbrt(12 * round_off));
  }
}

TEST(WaterlineOf, OfABoxIsProportionalToTheVolume) {
  EXPECT_NEAR(waterline_of(box_mesh({0, 0, -1}, {2, 3, 4}), 7.5).value(), 0.25, round_off);
}

/// A box of 60 x 30 x 20 with walls and floor of 2, open above, its floor's underside at z = 0.
TriangleMesh barge() {
  TriangleMesh hull = box_mesh({0, 0, 0}, {60, 30, 20}), hold = box_mesh({2, 2, 2}, {58, 28, 20});
  const auto on_top = [](const TriangleMesh& mesh, const Triangle& t) {
    return mesh.vertices[t[0]][2] == 20 && mesh.vertices[t[1]][2] == 20 && mesh.vertices[t[2]][2] == 20;
  };
  std::erase_if(hull.triangles, [&](const Triangle& t) { return on_top(hull, t); });
  std::erase_if(hold.triangles, [&](const Triangle& t) { return on_top(hold, t); });
  for (const Vec3& v : hold.vertices) hull.vertices.push_back(v);
  for (const auto& [a, b, c] : hold.triangles) hull.triangles.push_back({a + 8, c + 8, b + 8});
  // The rim: corners 4 5 7 6 of the hull, 12 13 15 14 of the hold, seen from above counter-clockwise.
  const std::array<std::uint32_t, 4> around{4, 5, 7, 6};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint32_t a = around[k], b = around[(k + 1) % 4];
    hull.triangles.push_back({a, b, b + 8});
    hull.triangles.push_back({a, b + 8, a + 8});
  }
  return hull;
}

TEST(Boat, KeepsWaterOutBelowItsRim) {
  const TriangleMesh boat = barge();
  const double material = 60 * 30 * 20 - 56 * 26 * 18;
  const Hydrostatics h = hydrostatics(boat, 6.75);
  EXPECT_NEAR(h.volume, 60 * 30 * 6.75, 1e-9);
  EXPECT_NEAR(h.dry, 56 * 26 * 4.75, 1e-9);
  EXPECT_NEAR(h.waterplane_area, 60 * 30, 1e-9);
  EXPECT_NEAR(h.least_second_moment, 60 * std::pow(30, 3) / 12, 1e-6);
  EXPECT_NEAR((h.centre_of_buoyancy - Vec3(30, 15, 6.75 / 2)).norm(), 0, 1e-9);
  EXPECT_NEAR(hydrostatics(boat, 20).volume, material, 1e-9);  // swamped
  EXPECT_EQ(hydrostatics(boat, 20).dry, 0);
  EXPECT_NEAR(waterline_of(boat, 12142.08).value(), 6.7456, 1e-9);  // 9792 mm^3 of 1.24 g/cm^3
  EXPECT_NEAR(waterline_of(boat, 35000).value(), 35000 / 1800.0, 1e-9);
  EXPECT_FALSE(waterline_of(boat, 36001));
  EXPECT_NEAR(most_displaced(boat), 36000, 1e-6);
}

TEST(Boat, HeelsUntilTheWaterComesOverItsRim) {
  // About its length, until the water z = a + t y is at the rim's inner edge: a + 13 t = 20. Its outer edge
  // is under by then, so that the section's area is 28 a + (13^2 - 15^2) t / 2 + 2 x 20 = 30 x 12.
  const auto heel = flooding_heel(barge(), 1800 * 12, 0);
  ASSERT_TRUE(heel);
  EXPECT_NEAR(std::tan(*heel), (20 - 320 / 28.0) / 14, 3e-5);  // a thousandth of a degree
}

TEST(Boat, WithAHoleInItsHullIsNone) {
  // A tower through the floor, open at both ends: as a ring it lets the water in.
  EXPECT_EQ(hydrostatics(ring_mesh(12, 2, 1, 0, 3), 2).dry, 0);
}

TEST(Boat, ASealedCavityIsDry) {
  TriangleMesh hollow = box_mesh({0, 0, 0}, {4, 4, 4});
  const TriangleMesh cavity = box_mesh({1, 1, 1}, {3, 3, 3});
  for (const Vec3& v : cavity.vertices) hollow.vertices.push_back(v);
  for (const auto& [a, b, c] : cavity.triangles) hollow.triangles.push_back({a + 8, c + 8, b + 8});
  EXPECT_NEAR(hydrostatics(hollow, 2).volume, 32, 1e-12);  // cut open by the plane
  EXPECT_NEAR(hydrostatics(hollow, 3.5).volume, 56, 1e-12);
  EXPECT_NEAR(hydrostatics(hollow, 3.5).dry, 8, 1e-12);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
