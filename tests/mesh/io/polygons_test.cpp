#include "mesh/io/polygons.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "mesh/mesh_folder.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/solid.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Outline = std::vector<std::array<double, 2>>;

/// The prism of a counter-clockwise outline, in the pose: its bases as one face each.
PolygonMesh prism(const Outline& outline, double height, const Eigen::Isometry3d& pose) {
  const auto n = std::uint32_t(outline.size());
  PolygonMesh mesh;
  for (const double z : {0.0, height})
    for (const auto& [x, y] : outline) mesh.vertices.push_back(pose * Vec3(x, y, z));
  std::vector<std::uint32_t> below, above;
  for (std::uint32_t i = 0; i < n; ++i) {
    below.push_back(n - 1 - i);
    above.push_back(n + i);
    mesh.add(std::array{i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  mesh.add(below);
  mesh.add(above);
  return mesh;
}

double area(const Outline& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

const Eigen::Isometry3d upright = Eigen::Isometry3d::Identity();
const Eigen::Isometry3d tilted =
    Eigen::Translation3d(5, -7, 11) * Eigen::Isometry3d(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()));

void expect_solid(const Outline& outline, std::size_t vertices) {
  for (const Eigen::Isometry3d& pose : {upright, tilted}) {
    const MeshReading reading = triangulated(prism(outline, 2, pose));
    EXPECT_TRUE(reading.notes.empty());
    const SolidMesh solid = make_solid(reading.mesh, "prism");
    EXPECT_NEAR(inspect(solid.mesh).volume, 2 * area(outline),
                1e-13 * 20 * 20 * 20);  // round-off of the pose
    EXPECT_EQ(solid.mesh.vertices.size(), vertices);
  }
}

TEST(Polygons, ConcaveFacesKeepTheirVolume) {
  expect_solid({{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 10}, {0, 10}}, 12);
  expect_solid({{0, 0}, {10, 0}, {5, 3}, {5, 10}}, 8);  // an arrow, from its tip and from elsewhere
  expect_solid({{10, 0}, {5, 3}, {5, 10}, {0, 0}}, 8);
  expect_solid({{5, 3}, {5, 10}, {0, 0}, {10, 0}}, 8);
}

TEST(Polygons, CombsAndSpiralsKeepTheirVolume) {
  Outline comb = {{0, 0}, {20, 0}};
  for (int i = 10; i > 0; --i) comb.insert(comb.end(), {{2.0 * i, 10}, {2.0 * i - 1, 1}});
  expect_solid(comb, 2 * comb.size());
  Outline spiral;
  for (int i = 0; i <= 60; ++i)
    spiral.push_back({(2 + 0.1 * i) * std::cos(0.3 * i), (2 + 0.1 * i) * std::sin(0.3 * i)});
  for (int i = 60; i >= 0; --i)
    spiral.push_back({(1 + 0.1 * i) * std::cos(0.3 * i), (1 + 0.1 * i) * std::sin(0.3 * i)});
  if (area(spiral) < 0) std::reverse(spiral.begin(), spiral.end());
  expect_solid(spiral, 2 * spiral.size());
}

TEST(Polygons, CornersOnStraightSidesStayCorners) {
  expect_solid({{0, 0}, {3, 0}, {6, 0}, {6, 4}, {3, 4}, {0, 4}, {0, 2}}, 14);
}

TEST(Polygons, CornersThatAreStraightButForRoundOffMakeNoSlivers) {
  // A square with corners along its sides, turned by many angles: round-off puts each to the left or right.
  Outline outline;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < 5; ++i) {
      const double t = 2 * i, x[4] = {t, 10, 10 - t, 0}, y[4] = {0, t, 10, 10 - t};
      outline.push_back({x[side], y[side]});
    }
  for (int turn = 0; turn < 50; ++turn) {
    const Eigen::Isometry3d pose(Eigen::AngleAxisd(0.1 + 0.07 * turn, Vec3(1, turn, 3).normalized()));
    const SolidMesh solid = make_solid(triangulated(prism(outline, 2, pose)).mesh, "prism");
    EXPECT_NEAR(inspect(solid.mesh).volume, 200, 1e-9);
    EXPECT_EQ(solid.mesh.vertices.size(), 2 * outline.size());
    for (const auto& [a, b, c] : solid.mesh.triangles) {  // the thinnest there need be has sides 2 and 2
      const Vec3 &p = solid.mesh.vertices[a], &q = solid.mesh.vertices[b], &r = solid.mesh.vertices[c];
      EXPECT_GT((q - p).cross(r - p).norm(), 1);
    }
  }
}

TEST(Polygons, RandomOutlinesKeepTheirVolume) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> radius(1, 10);
  for (int n = 4; n < 40; n += 3) {
    Outline outline;
    for (int i = 0; i < n; ++i) {
      const double r = radius(random), angle = 2 * M_PI * i / n;
      outline.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    expect_solid(outline, 2 * outline.size());
  }
}

class PolygonFiles : public MeshFolder {};

/// A square frame: bases with a hole cut to the outline, as OBJ has them.
const std::string frame =
    "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 3 3 0\nv 6 3 0\nv 6 6 0\nv 3 6 0\n"
    "v 0 0 2\nv 9 0 2\nv 9 9 2\nv 0 9 2\nv 3 3 2\nv 6 3 2\nv 6 6 2\nv 3 6 2\n"
    "f 9 10 11 12 9 13 16 15 14 13\nf 1 5 6 7 8 5 1 4 3 2\n"
    "f 1 2 10 9\nf 2 3 11 10\nf 3 4 12 11\nf 4 1 9 12\n"
    "f 5 13 14 6\nf 6 14 15 7\nf 7 15 16 8\nf 8 16 13 5\n";

TEST_F(PolygonFiles, HolesCutToTheOutlineStayHoles) {
  const SolidMesh solid = make_solid(read("a.obj", frame), "frame");
  EXPECT_DOUBLE_EQ(inspect(solid.mesh).volume, (81 - 9) * 2);
  EXPECT_EQ(solid.mesh.vertices.size(), 16u);
}

TEST_F(PolygonFiles, EveryFormatCutsThemAlike) {
  const std::vector<Triangle> want =
      read("a.obj", "v 0 0 0\nv 10 0 0\nv 5 3 0\nv 5 10 0\nf 1 2 3 4\n").triangles;
  EXPECT_EQ(want.size(), 2u);
  for (const Triangle& t : want)  // both have the corner that points inward
    EXPECT_TRUE(std::ranges::find(t, 2u) != t.end());
  EXPECT_EQ(read("a.off", "OFF\n4 1 0\n0 0 0\n10 0 0\n5 3 0\n5 10 0\n4 0 1 2 3\n").triangles, want);
  EXPECT_EQ(read("a.ply",
                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n10 0 0\n5 3 0\n5 10 0\n4 0 1 2 3\n")
                .triangles,
            want);
}

TEST_F(PolygonFiles, AFaceThatCrossesItselfIsToldOf) {
  const MeshReading reading =
      read_mesh_file(file("a.obj", "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nv 9 9 9\nf 1 2 3 4\nf 1 2 5\n"));
  ASSERT_EQ(reading.notes.size(), 1u);
  EXPECT_NE(reading.notes[0].find("1 face that crosses itself"), std::string::npos);
  EXPECT_EQ(reading.mesh.triangles.size(), 3u);
}

TEST_F(PolygonFiles, NearlyPlaneQuadsOfAConcaveKindStayWithin) {
  // The inner corner is lifted a little: the diagonal from it is still the only one within.
  const TriangleMesh mesh = read("a.obj", "v 0 0 0\nv 10 0 0.01\nv 3 3 -0.02\nv 0 10 0.01\nf 1 2 3 4\n");
  for (const Triangle& t : mesh.triangles) EXPECT_TRUE(std::ranges::find(t, 2u) != t.end());
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
