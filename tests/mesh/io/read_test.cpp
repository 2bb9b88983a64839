#include "mesh/io/read.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "body/models/geodesic.hpp"
#include "mesh/io/write.hpp"
#include "mesh/mesh_folder.hpp"
#include "mesh/solid/check.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class ReadMesh : public MeshFolder {};

const std::string off_tetrahedron =
    "OFF\n4 4 6\n0.12345678901234567 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string obj_vertices = "v 0.12345678901234567 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::vector<Triangle> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
         "\nendloop\nendfacet\n";
}

/// Binary STL of facets given as nine floats each.
std::string binary_stl(const std::string& header, const std::vector<std::array<float, 9>>& facets) {
  std::string bytes = header;
  bytes.resize(80);
  const auto count = std::uint32_t(facets.size());
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& f : facets) {
    bytes.append(12, '\0');
    bytes.append(reinterpret_cast<const char*>(f.data()), 36);
    bytes.append(2, '\0');
  }
  return bytes;
}

const std::array<float, 9> one_facet = {0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST_F(ReadMesh, KeepsEveryDigitOfOffCoordinates) {
  const TriangleMesh mesh = read("a.off", off_tetrahedron);
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[0].x(), 0.12345678901234567);
  EXPECT_EQ(mesh.triangles, tetrahedron);
}

TEST_F(ReadMesh, TakesOffWithCommentsCountsOnTheHeaderLineAndWindowsLineEnds) {
  const std::string body =
      "0 0 0\r\n1 0 0\r\n\r\n# between\r\n1 1 0 # behind\r\n0 1 0\r\n4 0 1 2 3 255 0 0\r\n";
  const std::vector<Triangle> fan = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(read("a.off", "# first\r\n\r\nOFF # header\r\n4 1 0\r\n" + body).triangles, fan);
  EXPECT_EQ(read("b.OFF", "OFF 4 1 0\r\n" + body).triangles, fan);
}

TEST_F(ReadMesh, PassesOverColoursAndNormalsOfOffVertices) {
  const TriangleMesh mesh = read(
      "a.off", "STCNOFF\n3 1 3\n0 0 0 9 9 9 255 0 0 1\n1 0 0 9 9 9 1 1 1 1\n0 1 2 9 9 9 1 1 1 1\n3 0 1 2\n");
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[2], Vec3(0, 1, 2));
}

TEST_F(ReadMesh, KeepsEveryDigitOfObjCoordinates) {
  const TriangleMesh mesh = read("a.obj", "mtllib none.mtl\n" + obj_vertices +
                                              "vn 0 0 1\nf 1//1 3//1 2//1\nf 1 2 4\nf 2/1 3/1 4/1\nf 3 1 4");
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[0].x(), 0.12345678901234567);
  EXPECT_EQ(mesh.triangles, tetrahedron);
}

TEST_F(ReadMesh, CountsNegativeObjIndicesBackFromTheirLine) {
  const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
  const std::vector<Triangle> want = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(read("a.obj", corner + corner).triangles, want);
}

TEST_F(ReadMesh, CutsObjPolygonsIntoFansAlsoOverContinuedLines) {
  const std::vector<Triangle> want = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(read("a.obj", "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 \\\r\n3 4\r\n").triangles, want);
}

TEST_F(ReadMesh, KeepsDuplicateAndConflictingFaces) {
  const std::vector<Triangle> want = {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}, {0, 1, 3}};
  EXPECT_EQ(read("a.obj", obj_vertices + "f 1 2 3\nf 1 2 3\nf 3 2 1\nf 1 2 4\n").triangles, want);
  EXPECT_EQ(
      read("a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 2\n3 2 1 0\n3 0 1 3\n").triangles,
      want);
}

TEST_F(ReadMesh, MergesTextStlCornersOnlyWhereAllDigitsAgree) {
  const std::string text = "solid a b\n" + facet("0.12345678901234567 0 0", "1 0 0", "0 1 0") +
                           facet("0.12345678901234569 0 0", "0 1 0", "1 -0 0") + "endsolid a b\n";
  const TriangleMesh mesh = read("a.stl", text);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.vertices[0].x(), 0.12345678901234567);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 2, 1}}));
}

TEST_F(ReadMesh, TakesBinaryStlWhoseHeaderBeginsWithSolid) {
  const TriangleMesh mesh = read("a.STL", binary_stl("solid made elsewhere", {one_facet}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST_F(ReadMesh, GetsBackTheSphereThatWasWrittenAsStl) {
  const TriangleMesh sphere = geodesic_sphere(7);
  write_mesh(folder_ / "s.stl", {sphere});
  const TriangleMesh back = read_mesh(folder_ / "s.stl");
  EXPECT_EQ(back.vertices.size(), sphere.vertices.size());
  ASSERT_EQ(back.triangles.size(), sphere.triangles.size());
  EXPECT_NO_THROW(require_solid(back, "sphere"));
  for (std::size_t t = 0; t < back.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)  // each coordinate at most 1, rounded to float once
      EXPECT_LE((back.vertices[back.triangles[t][k]] - sphere.vertices[sphere.triangles[t][k]])
                    .cwiseAbs()
                    .maxCoeff(),
                0.5 * double(std::numeric_limits<float>::epsilon()));
}

TEST_F(ReadMesh, RefusesWhatIsNoMeshFile) {
  refuses(folder_ / "absent.stl", {"no such file"});
  std::filesystem::create_directory(folder_ / "folder.obj");
  refuses(folder_ / "folder.obj", {"directory"});
  refuses(file("a.step", "ISO\n"), {"'.step'", ".stl, .3mf, .obj, .ply or .off"});
  refuses(file("plain", "OFF\n"), {"extension ''"});
  for (const std::string name : {"e.stl", "e.obj", "e.off", "e.ply", "e.3mf"})
    refuses(file(name, ""), {"empty file"});
}

TEST_F(ReadMesh, NamesExpectedAndFoundLengthOfCutOffBinaryStl) {
  const std::string whole = binary_stl("cut", {one_facet, one_facet});
  refuses(file("a.stl", whole.substr(0, 150)), {"150", "184"});
  refuses(file("b.stl", whole.substr(0, 60)), {"60", "84"});
  refuses(file("c.stl", binary_stl("solid cut", {one_facet}).substr(0, 100)), {"100", "134"});
}

TEST_F(ReadMesh, PassesOverALittleBehindTheFacetsOfBinaryStlAndTells) {
  const std::string whole = binary_stl("padded", {one_facet, one_facet});
  const MeshReading reading = read_mesh_file(file("a.stl", whole + std::string(49, '\0')));
  EXPECT_EQ(reading.mesh.triangles.size(), 2u);
  EXPECT_EQ(reading.notes, std::vector<std::string>{"passed over 49 bytes behind the facets"});
  EXPECT_TRUE(read_mesh_file(file("b.stl", whole)).notes.empty());
  refuses(file("c.stl", whole + std::string(50, '\0')), {"234", "184"});  // a facet that is not counted
}

TEST_F(ReadMesh, ShowsJunkInAMessageAsShortPrintableText) {
  const std::string junk = std::string("\x01\0\xff", 3) + std::string(100, 'x');
  refuses(file("a.off", "OFF\n3 1 0\n0 " + junk + " 0\n"), {"'???xxx", "...'", "vertex 1"});
  refuses(file("a.ply", "ply\nformat " + junk + " 1.0\nend_header\n"), {"'???xxx", "...'", "ascii"});
}

TEST_F(ReadMesh, RefusesTextThatClaimsToBeStl) {
  refuses(file("a.stl", "solid words\nThis is a letter, not a mesh.\n"), {"line 2", "'This'", "text STL"});
  refuses(file("b.stl", "A letter, not a mesh.\n"), {"binary STL of 22 bytes", "84"});
}

TEST_F(ReadMesh, NamesWhereTextStlBreaks) {
  const std::string good = facet("0 0 0", "1 0 0", "0 1 0");
  refuses(file("a.stl", "solid\n" + good), {"line 8", "endsolid"});
  refuses(file("b.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
          {"line 6", "2 vertices"});
  refuses(file("c.stl", "solid\n" + facet("0 0 0", "nan 0 0", "0 1 0") + "endsolid\n"),
          {"line 5", "vertex 2", "'nan'"});
  refuses(file("d.stl", "solid\nnonsense\nendsolid\n"), {"line 2", "'nonsense'"});
}

TEST_F(ReadMesh, NamesTheVertexThatIsNotFinite) {
  auto bad = one_facet;
  bad[5] = std::numeric_limits<float>::infinity();
  refuses(file("a.stl", binary_stl("", {one_facet, bad})), {"vertex 2 of facet 2", "inf"});
  refuses(file("a.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"), {"line 2", "vertex 2", "'nan'"});
  refuses(file("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 -inf\n3 0 1 2\n"), {"line 5", "vertex 3", "'-inf'"});
  refuses(file("b.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), {"line 4", "vertex 2", "''"});
}

TEST_F(ReadMesh, NamesTheIndexThatIsOutOfRange) {
  refuses(file("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), {"line 6", "'3'", "0 to 2"});
  refuses(file("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), {"line 6", "'-1'"});
  refuses(file("a.obj", obj_vertices + "f 1 2 3\nf 1 2 5\n"), {"face 2", "index 5", "1 to 4"});
  refuses(file("b.obj", obj_vertices + "f 1 2 -5\n"), {"face 1", "1 to 4"});
  refuses(file("c.obj", obj_vertices + "f 0 1 2\n"), {"line 5", "'0'"});
  refuses(file("d.obj", obj_vertices + "f 1 2 99999999999\n"), {"line 5", "'99999999999'"});
}

TEST_F(ReadMesh, RefusesFacesWithoutThreeDifferentCorners) {
  refuses(file("a.obj", obj_vertices + "f 1 2\n"), {"line 5", "2 corners"});
  refuses(file("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), {"line 6", "'2'"});
}

TEST_F(ReadMesh, NamesHowMuchOfAnOffFileIsMissing) {
  refuses(file("a.off", "OFF\n4 4 6\n0 0 0\n1 0 0\n"), {"2 vertices, expected 4"});
  refuses(file("b.off", off_tetrahedron.substr(0, off_tetrahedron.size() - 16)), {"2 faces, expected 4"});
  refuses(file("c.off", "PLY\n"), {"'PLY'", "expected OFF"});
  refuses(file("d.off", "OFF\n-4 4 0\n"), {"'-4 4'"});
  refuses(file("e.off", "OFF BINARY\n"), {"BINARY", "text OFF"});
  refuses(file("f.off", "OFF\n"), {"counts"});
}

TEST_F(ReadMesh, RefusesAMeshWithoutTriangles) {
  refuses(file("a.off", "OFF\n0 0 0\n"), {"no triangles"});
  refuses(file("a.obj", obj_vertices), {"no triangles"});
  refuses(file("a.stl", "solid none\nendsolid none\n"), {"no triangles"});
  refuses(file("b.stl", binary_stl("none", {})), {"no triangles"});
}

TEST_F(ReadMesh, WritesNothingToStandardError) {
  ::testing::internal::CaptureStderr();
  (void)read("a.obj", "mtllib none.mtl\n" + obj_vertices + "usemtl gone\nf 1 2 3\n");
  refuses(file("b.obj", obj_vertices + "f 1 1 2\nf 1 2 9\n"), {});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
