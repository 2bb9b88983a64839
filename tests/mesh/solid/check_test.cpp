#include "mesh/solid/check.hpp"

#include <gtest/gtest.h>

#include <string>

#include "body/models/geodesic.hpp"
#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Corner at the origin, legs of length 2: volume 8/6.
TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

void refuses(const TriangleMesh& mesh, const std::vector<std::string>& parts) {
  expect_refusal([&] { require_solid(mesh, "part.stl"); }, "part.stl: ", parts);
}

TEST(Check, AcceptsATetrahedronAndMeasuresIt) {
  const MeshReport report = inspect(tetrahedron());
  EXPECT_TRUE(report.watertight());
  EXPECT_TRUE(report.oriented());
  EXPECT_NEAR(report.volume, 8.0 / 6, report.negligible_volume);
  EXPECT_NO_THROW(require_solid(tetrahedron(), "tetrahedron"));
}

TEST(Check, NamesNumberAndPlaceOfOpenEdges) {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  EXPECT_EQ(inspect(mesh).open.count, 3u);
  refuses(mesh, {"open edges: 3", "(0, 0, 0) to (0, 2, 0)", "watertight"});
}

TEST(Check, NamesAnEdgeOfMoreThanTwoTriangles) {
  TriangleMesh mesh = tetrahedron();
  mesh.vertices.emplace_back(9, 9, 9);
  mesh.triangles.push_back({1, 2, 4});
  EXPECT_EQ(inspect(mesh).crowded.count, 1u);
  refuses(mesh, {"more than two triangles: 1", "(2, 0, 0) to (0, 2, 0)"});
}

TEST(Check, NamesAnEdgeAlongWhichTwoTrianglesRunTheSameWay) {
  TriangleMesh mesh = tetrahedron();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  EXPECT_EQ(inspect(mesh).misoriented.count, 3u);
  EXPECT_TRUE(inspect(mesh).watertight());
  refuses(mesh, {"same way: 3", "(0, 0, 0) to (0, 2, 0)", "counter-clockwise"});
}

TEST(Check, SaysThatASolidIsInsideOutAndHowToMendIt) {
  TriangleMesh mesh = tetrahedron();
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  refuses(mesh, {"inside out", "-1.33333", "reverse"});
}

TEST(Check, NamesATriangleThatUsesAVertexTwice) {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.push_back({3, 3, 1});
  refuses(mesh, {"degenerate", "twice: 1", "number 5", "(0, 0, 2)"});
}

TEST(Check, RefusesAFlatBodyAlsoFarFromTheOrigin) {
  for (const double offset : {0.0, 0.1, 1e6}) {
    TriangleMesh mesh = tetrahedron();
    mesh.vertices[3] = Vec3(0.7, 0.4, 0);
    for (Vec3& v : mesh.vertices) v = Vec3(v.x(), v.y(), v.x() / 3 + v.y() / 7) + Vec3::Constant(offset);
    refuses(mesh, {"no volume"});
  }
}

TEST(Check, RefusesAMeshWithoutTriangles) { refuses({}, {"no triangles"}); }

TEST(Check, MeasuresASphereFarFromTheOrigin) {
  TriangleMesh near = geodesic_sphere(16), far = near;
  for (Vec3& v : far.vertices) v += Vec3(1e5, -2e5, 3e5);
  const MeshReport report = inspect(far);
  EXPECT_NEAR(report.volume, inspect(near).volume, report.negligible_volume);
  EXPECT_LT(report.negligible_volume, 1e-6);
  EXPECT_NO_THROW(require_solid(far, "sphere"));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
