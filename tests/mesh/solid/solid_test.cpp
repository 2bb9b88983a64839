#include "mesh/solid/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "body/models/geodesic.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

void refuses(const TriangleMesh& mesh, const std::vector<std::string>& parts) {
  expect_refusal([&] { (void)make_solid(mesh, "part.stl"); }, "part.stl: ", parts);
}

const TriangleMesh cube = box_mesh({0, 0, 0}, {3, 3, 3});

TEST(MakeSolid, MendsWhatIsSafeAndSaysSo) {
  const SolidMesh solid = make_solid(inverted(soup(cube)), "cube");
  EXPECT_DOUBLE_EQ(inspect(solid.mesh).volume, 27);
  EXPECT_EQ(solid.repairs.lines,
            (std::vector<std::string>{"merged 28 equal vertices", "turned 1 inside-out shell"}));
}

TEST(MakeSolid, KeepsCavitiesAndIslandsWithinThem) {
  TriangleMesh mesh = both(cube, inverted(box_mesh({1, 1, 1}, {2, 2, 2})));
  mesh = both(mesh, box_mesh({1.25, 1.25, 1.25}, {1.75, 1.75, 1.75}));
  const SolidMesh solid = make_solid(mesh, "nested");
  EXPECT_DOUBLE_EQ(inspect(solid.mesh).volume, 27 - 1 + 0.125);
  EXPECT_EQ(solid.repairs.lines,
            (std::vector<std::string>{"kept 1 cavity, a shell inside the solid that faces inward"}));
}

TEST(MakeSolid, CountsASolidWithinASolidOnce) {
  const SolidMesh solid = make_solid(both(cube, box_mesh({1, 1, 1}, {2, 2, 2})), "nested");
  EXPECT_DOUBLE_EQ(inspect(solid.mesh).volume, 27);
  EXPECT_EQ(solid.repairs.lines,
            (std::vector<std::string>{"united what overlaps: 1 mm^3 are enclosed more than "
                                      "once; of 24 triangles 12 are as they were"}));
}

TEST(MakeSolid, RefusesAnInwardShellWithinACavity) {
  TriangleMesh mesh = both(cube, inverted(box_mesh({1, 1, 1}, {2, 2, 2})));
  refuses(both(mesh, inverted(box_mesh({1.25, 1.25, 1.25}, {1.75, 1.75, 1.75}))),
          {"0.125 mm^3 are enclosed inside out", "--inside-out"});
}

TEST(MakeSolid, UnitesASurfaceThatRunsThroughItselfInTheUnitOfTheFile) {
  Surface surface(both(cube, box_mesh({1, 1, 2}, {2, 2, 4})));
  const SolidMesh solid = make_solid(surface, "part", {}, 10);
  EXPECT_NEAR(inspect(solid.mesh).volume, 28, 1e-12);
  ASSERT_EQ(solid.repairs.lines.size(), 1u);
  EXPECT_EQ(solid.repairs.lines[0].find("united what overlaps: 1000 mm^3"), 0u) << solid.repairs.lines[0];
  // What we wrote ourselves is to be sound as it is.
  expect_refusal(
      [] {
        require_sound(both(cube, box_mesh({1, 1, 2}, {2, 2, 4})), "part.stl");
      },
      "part.stl: ", {"runs through itself", "pairs of triangles", "the first 3 at", "self-intersections"});
}

TEST(MakeSolid, TellsPiecesApart) {
  const TriangleMesh apart =
      both(both(box_mesh({5, 0, 0}, {6, 1, 1}), cube), inverted(box_mesh({1, 1, 1}, {2, 2, 2})));
  SolidMesh solid = make_solid(apart, "pieces");
  ASSERT_EQ(solid.pieces.size(), 2u);
  EXPECT_NEAR(solid.pieces[0].volume, 26, 1e-12);
  EXPECT_NEAR(solid.pieces[1].volume, 1, 1e-12);
  EXPECT_EQ(solid.mesh.triangles.size(), 36u);
  solid = make_solid(apart, "pieces", {.pieces = {1}});
  EXPECT_NEAR(inspect(solid.mesh).volume, 26, 1e-12);
  EXPECT_EQ(solid.mesh.vertices.size(), 16u);
  EXPECT_EQ(solid.repairs.lines[0], "left out 1 of 2 pieces, 1 mm^3");
  expect_refusal([&] { (void)make_solid(apart, "pieces", {.pieces = {3}}); }, "pieces: piece 3", {"1 to 2"});
  // An island in a cavity is loose, what touches in an edge or a corner is not.
  const TriangleMesh island = both(both(cube, inverted(box_mesh({1, 1, 1}, {2, 2, 2}))),
                                   box_mesh({1.25, 1.25, 1.25}, {1.75, 1.75, 1.75}));
  EXPECT_EQ(make_solid(island, "island").pieces.size(), 2u);
  EXPECT_EQ(make_solid(both(cube, box_mesh({3, 3, 0}, {4, 4, 3})), "edge").pieces.size(), 1u);
  EXPECT_EQ(make_solid(both(cube, box_mesh({3, 3, 3}, {4, 4, 4})), "corner").pieces.size(), 1u);
}

TEST(MakeSolid, RefusesOpenCrowdedFlatAndOneSidedSurfaces) {
  TriangleMesh open = cube;
  open.triangles.pop_back();
  refuses(open, {"open edges: 3", "watertight"});
  TriangleMesh fin = cube;
  fin.vertices.push_back({9, 9, 9});
  fin.triangles.push_back({0, 1, 8});
  refuses(fin, {"more than two triangles: 1"});
  TriangleMesh flat = cube;
  for (Vec3& v : flat.vertices) v.z() = v.x();
  refuses(flat, {"no volume"});
  refuses(torus(8, 6, /*twisted=*/true), {"cannot be oriented", "inside"});
  refuses({}, {"no triangles"});
}

TEST(MakeSolid, AcceptsSolidsThatTouchAlongAnEdge) {
  const TriangleMesh touching = both(cube, box_mesh({3, 3, 0}, {4, 4, 3}));
  EXPECT_DOUBLE_EQ(inspect(make_solid(soup(touching), "touching").mesh).volume, 30);
}

/// The faces between filled and empty cells of a grid, as STL would have them: no shared vertices.
TriangleMesh cells(const std::vector<bool>& filled, int n) {
  const auto at = [&](int i, int j, int k) {
    return i >= 0 && j >= 0 && k >= 0 && i < n && j < n && k < n && filled[std::size_t((i * n + j) * n + k)];
  };
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        for (int face = 0; face < 6 && at(i, j, k); ++face) {
          const int axis = face / 2, up = face % 2;
          const Vec3 step = Vec3::Unit(axis) * (2 * up - 1);
          if (at(i + int(step.x()), j + int(step.y()), k + int(step.z()))) continue;
          const Vec3 p = Vec3(i, j, k) + up * Vec3::Unit(axis);
          Vec3 u = Vec3::Unit((axis + 1) % 3), v = Vec3::Unit((axis + 2) % 3);
          if (!up) std::swap(u, v);
          const auto n0 = std::uint32_t(mesh.vertices.size());
          mesh.vertices.insert(mesh.vertices.end(), {p, p + u, p + u + v, p + v});
          mesh.triangles.insert(mesh.triangles.end(), {{n0, n0 + 1, n0 + 2}, {n0, n0 + 2, n0 + 3}});
        }
  return mesh;
}

TEST(MakeSolid, JoinsThroughAnEdgeWhatHangsTogetherAroundBothItsEnds) {
  // Two cells side by side diagonally, with full layers below and above: they cannot be taken apart there.
  std::vector<bool> filled(27, true);
  for (const int cell : {0 * 9 + 0 * 3 + 1, 1 * 9 + 1 * 3 + 1}) filled[std::size_t(cell)] = false;
  const TriangleMesh solid = make_solid(cells(filled, 3), "cells").mesh;
  EXPECT_DOUBLE_EQ(inspect(solid).volume, 25);
  EXPECT_EQ(inspect(solid).crowded.count, 0u);
}

TEST(MakeSolid, MendsEveryHeapOfCellsThatTouchAlongEdgesAndCorners) {
  std::mt19937 random(11);
  for (int repeat = 0; repeat < 60; ++repeat) {
    std::vector<bool> filled(64);
    const auto percent = 20 + random() % 50;
    for (std::size_t c = 0; c < filled.size(); ++c) filled[c] = random() % 100 < percent;
    const auto count = std::count(filled.begin(), filled.end(), true);
    TriangleMesh mesh = cells(filled, 4);
    if (repeat % 2) mesh = inverted(mesh);
    const TriangleMesh solid = make_solid(mesh, "cells").mesh;
    EXPECT_NEAR(inspect(solid).volume, double(count), 1e-12 * double(count))
        << repeat;  // sums of whole numbers
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
