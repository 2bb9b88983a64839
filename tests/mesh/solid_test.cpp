#include "mesh/solid.hpp"

#include <gtest/gtest.h>

#include "body/models/geodesic.hpp"
#include "error.hpp"
#include "mesh/check.hpp"
#include "mesh/shapes.hpp"

namespace kreisel {
namespace {

void refuses(const TriangleMesh& mesh, const std::vector<std::string>& parts) {
  RepairReport report;
  try {
    (void)make_solid(mesh, "part.stl", report);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.find("part.stl: "), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.find("expected"), std::string::npos) << text;
    for (const auto& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  }
}

const TriangleMesh cube = box_mesh({0, 0, 0}, {3, 3, 3});

TEST(MakeSolid, MendsWhatIsSafeAndSaysSo) {
  RepairReport report;
  const TriangleMesh solid = make_solid(inverted(soup(cube)), "cube", report);
  EXPECT_DOUBLE_EQ(inspect(solid).volume, 27);
  EXPECT_EQ(report.lines,
            (std::vector<std::string>{"merged 28 equal vertices", "turned 1 inside-out shell"}));
}

TEST(MakeSolid, KeepsCavitiesAndIslandsWithinThem) {
  RepairReport report;
  TriangleMesh mesh = both(cube, inverted(box_mesh({1, 1, 1}, {2, 2, 2})));
  mesh = both(mesh, box_mesh({1.25, 1.25, 1.25}, {1.75, 1.75, 1.75}));
  EXPECT_DOUBLE_EQ(inspect(make_solid(mesh, "nested", report)).volume, 27 - 1 + 0.125);
  EXPECT_EQ(report.lines,
            (std::vector<std::string>{"kept 1 cavity, a shell inside the solid that faces inward"}));
}

TEST(MakeSolid, RefusesASolidWithinASolid) {
  refuses(both(cube, box_mesh({1, 1, 1}, {2, 2, 2})),
          {"12 triangles", "inside another", "faces outward", "counts its material twice"});
}

TEST(MakeSolid, RefusesAnInwardShellWithinACavity) {
  TriangleMesh mesh = both(cube, inverted(box_mesh({1, 1, 1}, {2, 2, 2})));
  refuses(both(mesh, inverted(box_mesh({1.25, 1.25, 1.25}, {1.75, 1.75, 1.75}))),
          {"inside 2 others", "faces inward"});
}

TEST(MakeSolid, RefusesSurfacesThatRunThroughThemselves) {
  TriangleMesh mesh = both(cube, box_mesh({1, 1, 2}, {2, 2, 4}));
  refuses(mesh, {"runs through itself", "pairs of triangles", "the first 3 at", "self-intersections"});
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
  RepairReport report;
  const TriangleMesh touching = both(cube, box_mesh({3, 3, 0}, {4, 4, 3}));
  EXPECT_DOUBLE_EQ(inspect(make_solid(soup(touching), "touching", report)).volume, 30);
}

}  // namespace
}  // namespace kreisel
