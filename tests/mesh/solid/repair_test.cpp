#include "mesh/solid/repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "body/models/geodesic.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/components.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using Lines = std::vector<std::string>;

const TriangleMesh cube = box_mesh({0, 0, 0}, {1, 1, 1});

/// Repairs, compares the report, and returns the mesh.
TriangleMesh repair(const TriangleMesh& mesh, const Lines& want) {
  RepairReport report;
  TriangleMesh result = repaired(mesh, report);
  EXPECT_EQ(report.lines, want);
  return result;
}

TEST(Repair, LeavesASolidAsItIs) {
  const TriangleMesh sphere = geodesic_sphere(5), result = repair(sphere, {});
  EXPECT_EQ(result.vertices, sphere.vertices);
  EXPECT_EQ(result.triangles, sphere.triangles);
}

TEST(Repair, MergesEqualVertices) {
  const TriangleMesh result = repair(soup(cube), {"merged 28 equal vertices"});
  EXPECT_EQ(result.vertices.size(), 8u);
  EXPECT_NO_THROW(require_solid(result, "cube"));
}

TEST(Repair, MergesOnlyWhatIsExactlyEqual) {
  TriangleMesh mesh = soup(cube);
  mesh.vertices[0].x() = 1e-300;
  EXPECT_GT(inspect(repair(mesh, {"merged 27 equal vertices"})).open.count, 0u);
}

TEST(Repair, DropsUnusedVerticesAndTrianglesThatUseAVertexTwice) {
  TriangleMesh mesh = cube;
  mesh.vertices.insert(mesh.vertices.begin(), Vec3(50, 50, 50));
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) ++v;
  mesh.triangles.push_back({3, 3, 4});
  const TriangleMesh result =
      repair(mesh, {"dropped 1 triangle that uses a vertex twice", "dropped 1 unused vertex"});
  EXPECT_EQ(result.vertices, cube.vertices);
  EXPECT_EQ(result.triangles, cube.triangles);
}

TEST(Repair, DropsARepeatedTriangleOnlyWhereNoHoleIsLeft) {
  TriangleMesh mesh = cube;
  mesh.triangles.push_back({mesh.triangles[4][1], mesh.triangles[4][2], mesh.triangles[4][0]});
  EXPECT_EQ(repair(mesh, {"dropped 1 repeated triangle"}).triangles, cube.triangles);
  mesh.triangles.erase(mesh.triangles.begin());  // now there is a hole anyway
  EXPECT_EQ(repair(mesh, {}).triangles.size(), 12u);
}

TEST(Repair, DropsTrianglesWithoutAreaOnlyWhereNoHoleIsLeft) {
  // Twice the same three points on one edge of the cube, once each way round: a fin without area.
  TriangleMesh mesh = cube;
  mesh.vertices.push_back({0.5, 0, 0});
  mesh.triangles.push_back({0, 8, 1});
  mesh.triangles.push_back({8, 0, 1});
  const TriangleMesh result = repair(mesh, {"dropped 2 triangles without area", "dropped 1 unused vertex"});
  EXPECT_EQ(result.triangles, cube.triangles);
}

/// The cube with a vertex in the middle of an edge that only one of its two triangles there knows; triangles
/// without area close the gap.
TriangleMesh split_on_one_side(const std::vector<Vec3>& points, const std::vector<Triangle>& fill) {
  TriangleMesh mesh = cube;
  mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end());
  std::erase(mesh.triangles, Triangle{0, 1, 5});
  mesh.triangles.insert(mesh.triangles.end(), fill.begin(), fill.end());
  return mesh;
}

TEST(Repair, FlipsATriangleWithoutAreaThatBridgesATJunction) {
  const TriangleMesh split = split_on_one_side({{0.5, 0, 0}}, {{0, 8, 5}, {8, 1, 5}, {0, 1, 8}});
  const TriangleMesh result = repair(split, {"flipped 1 triangle without area into its neighbour"});
  EXPECT_NO_THROW(require_solid(result, "split"));
  EXPECT_EQ(inspect(result).flat_count, 0u);
  EXPECT_EQ(result.triangles.size(), 14u);
  EXPECT_DOUBLE_EQ(inspect(result).volume, 1);
  EXPECT_TRUE(self_intersections(result).empty());
  EXPECT_FALSE(self_intersections(split).empty());  // without it the two sides of the junction only touch
}

TEST(Repair, FlipsTrianglesWithoutAreaOneAfterTheOther) {
  // Two more vertices on the edge, closed by two flat triangles, one behind the other.
  const TriangleMesh split =
      split_on_one_side({{0.25, 0, 0}, {0.5, 0, 0}}, {{0, 8, 5}, {8, 9, 5}, {9, 1, 5}, {0, 9, 8}, {0, 1, 9}});
  const TriangleMesh result = repair(split, {"flipped 2 triangles without area into their neighbours"});
  EXPECT_NO_THROW(require_solid(result, "split"));
  EXPECT_EQ(inspect(result).flat_count, 0u);
  EXPECT_DOUBLE_EQ(inspect(result).volume, 1);
}

TEST(Repair, TurnsTheFewestTriangles) {
  TriangleMesh mesh = geodesic_sphere(4);
  for (const std::size_t t : {3, 30, 31, 200}) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const TriangleMesh result = repair(mesh, {"turned 4 triangles to run the same way round as the rest"});
  EXPECT_NO_THROW(require_solid(result, "sphere"));
}

TEST(Repair, TurnsAnInsideOutSolidWithAllItEncloses) {
  const TriangleMesh hollow = both(box_mesh({0, 0, 0}, {3, 3, 3}), inverted(box_mesh({1, 1, 1}, {2, 2, 2})));
  EXPECT_DOUBLE_EQ(inspect(repair(hollow, {})).volume, 26);
  EXPECT_DOUBLE_EQ(inspect(repair(inverted(hollow), {"turned 2 inside-out shells"})).volume, 26);
  // One of two solids side by side.
  const TriangleMesh pair = both(cube, inverted(box_mesh({5, 0, 0}, {6, 1, 1})));
  EXPECT_DOUBLE_EQ(inspect(repair(pair, {"turned 1 inside-out shell"})).volume, 2);
}

TEST(Repair, DoesNotGuessTheDirectionOfAnInnerShell) {
  const TriangleMesh nested = both(box_mesh({0, 0, 0}, {3, 3, 3}), box_mesh({1, 1, 1}, {2, 2, 2}));
  EXPECT_EQ(repair(nested, {}).triangles, nested.triangles);
}

TEST(Repair, LeavesAKleinBottle) {
  const TriangleMesh klein = torus(8, 6, /*twisted=*/true);
  RepairReport report;
  EXPECT_FALSE(inspect(repaired(klein, report)).oriented());
}

TEST(Repair, KeepsSolidsApartThatTouchAlongAnEdge) {
  const TriangleMesh touching = both(cube, box_mesh({1, 1, 0}, {2, 2, 1}));
  const TriangleMesh result =
      repair(touching, {"left 2 equal vertices apart: merged, edges would have more than two triangles"});
  EXPECT_NO_THROW(require_solid(result, "touching"));
}

TEST(Repair, SeparatesSolidsThatShareAnEdge) {
  // As they come from STL: all equal corners are one vertex, the edge has four triangles.
  const TriangleMesh touching = both(cube, box_mesh({1, 1, 0}, {2, 2, 1}));
  const TriangleMesh result = repair(
      soup(touching), {"merged 58 equal vertices", "separated 1 edge at which parts of the solid touch"});
  EXPECT_EQ(result.vertices.size(), 16u);
  EXPECT_NO_THROW(require_solid(result, "touching"));
  EXPECT_EQ(shells(result).size(), 2u);
  EXPECT_DOUBLE_EQ(inspect(result).volume, 2);
}

TEST(Repair, SeparatesThreeWedgesAroundOneEdge) {
  TriangleMesh wedges;
  for (int k = 0; k < 3; ++k) {
    const double a = 2 * k, b = 2 * k + 1;  // angles in radian, a gap between any two
    wedges =
        both(wedges, {{{0, 0, 0}, {0, 0, 1}, {std::cos(a), std::sin(a), 0}, {std::cos(b), std::sin(b), 0}},
                      {{0, 3, 2}, {0, 1, 3}, {0, 2, 1}, {1, 2, 3}}});
  }
  const TriangleMesh result = repair(
      soup(wedges), {"merged 28 equal vertices", "separated 1 edge at which parts of the solid touch"});
  EXPECT_EQ(shells(result).size(), 3u);
  EXPECT_NO_THROW(require_solid(result, "wedges"));
}

TEST(Repair, LeavesEdgesWhoseTrianglesLieOnEachOther) {
  // Two cubes that share a whole face: around its edges two triangles have the same direction.
  const TriangleMesh glued = both(cube, box_mesh({0, 0, 1}, {1, 1, 2}));
  RepairReport report;
  EXPECT_GT(inspect(repaired(soup(glued), report)).crowded.count, 0u);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
