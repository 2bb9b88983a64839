#include "mesh/io/read_3mf.hpp"

#include <gtest/gtest.h>

#include "mesh/mesh_folder.hpp"
#include "mesh/zip_file.hpp"

namespace kreisel::core {
namespace {

class Read3mf : public MeshFolder {};

/// A package around the content of <model>.
std::string package(const std::string& content, const std::string& attributes = "unit=\"millimeter\"") {
  const std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";
  return zip_file(
      {{"[Content_Types].xml",
        xml + "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default "
              "Extension=\"rels\" "
              "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default "
              "Extension=\"model\" "
              "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>"},
       {"_rels/.rels",
        xml + "<Relationships "
              "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship "
              "Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
              "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
       {"3D/3dmodel.model", xml +
                                "<model xml:lang=\"en-US\" "
                                "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" " +
                                attributes + ">" + content + "</model>"}});
}

/// A tetrahedron with legs 1, 2, 3.
std::string object(int id, const std::string& type = "model", const std::string& last_triangle = "2 0 3",
                   const std::string& last_x = "0") {
  const std::string& t = last_triangle;
  return "<object id=\"" + std::to_string(id) + "\" type=\"" + type +
         "\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
         "<vertex x=\"0\" y=\"2\" z=\"0\"/><vertex x=\"" +
         last_x +
         "\" y=\"0\" z=\"3\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/>"
         "<triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"" +
         t[0] + "\" v2=\"" + t[2] + "\" v3=\"" + t[4] + "\"/></triangles></mesh></object>";
}

std::string resources(const std::string& objects) { return "<resources>" + objects + "</resources>"; }
std::string build(const std::string& items) { return "<build>" + items + "</build>"; }
const std::string item = "<item objectid=\"1\"/>";
const std::vector<Triangle> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

TEST_F(Read3mf, TurnsEveryUnitIntoMillimetres) {
  const std::pair<const char*, double> units[] = {{"micron", 1e-3}, {"millimeter", 1}, {"centimeter", 10},
                                                  {"inch", 25.4},   {"foot", 304.8},   {"meter", 1000}};
  for (const auto& [unit, factor] : units) {
    const TriangleMesh mesh =
        read("a.3mf", package(resources(object(1)) + build(item), "unit=\"" + std::string(unit) + "\""));
    EXPECT_EQ(mesh.vertices,
              (std::vector<Vec3>{{0, 0, 0}, {factor, 0, 0}, {0, 2 * factor, 0}, {0, 0, 3 * factor}}))
        << unit;
    EXPECT_EQ(mesh.triangles, tetrahedron);
  }
}

TEST_F(Read3mf, MovesAndTurnsItemsByTheirTransform) {
  // Rows of the transform are the images of x, y, z, then the offset: x -> y, y -> z, z -> x.
  const TriangleMesh mesh =
      read("a.3mf", package(resources(object(1)) +
                            build("<item objectid=\"1\" transform=\"0 1 0 0 0 1 1 0 0 10 20 30\"/>")));
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{10, 20, 30}, {10, 21, 30}, {10, 20, 32}, {13, 20, 30}}));
}

TEST_F(Read3mf, MergesItemsAndComponentsAndKeepsMirroredOnesOutward) {
  const TriangleMesh mesh = read(
      "a.3mf",
      package(resources(object(1) + "<object id=\"2\" type=\"model\"><components><component objectid=\"1\"/>"
                                    "<component objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 5 0 0\"/>"
                                    "</components></object>") +
                  build("<item objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 0 0 100\"/>" + item),
              "unit=\"centimeter\""));
  ASSERT_EQ(mesh.vertices.size(), 12u);
  EXPECT_EQ(mesh.vertices[1], Vec3(20, 0, 1000));
  EXPECT_EQ(mesh.vertices[4], Vec3(100, 0, 1000));
  EXPECT_EQ(mesh.vertices[5], Vec3(80, 0, 1000));
  EXPECT_EQ(mesh.vertices[9], Vec3(10, 0, 0));
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 2, 1}));
  EXPECT_EQ(mesh.triangles[4], (Triangle{4, 5, 6}));  // mirrored: the other way round
  EXPECT_EQ(mesh.triangles[8], (Triangle{8, 10, 9}));
}

TEST_F(Read3mf, PassesOverSupportsAndWhatSlicersAdd) {
  const TriangleMesh mesh =
      read("a.3mf", package("<metadata name=\"slic3rpe:Version3mf\">1</metadata>" +
                                resources(object(1) + object(2, "support")) +
                                build("<item objectid=\"1\" printable=\"1\"/><item objectid=\"2\"/>"),
                            "unit=\"millimeter\" xmlns:slic3rpe=\"http://schemas.slic3r.org/3mf/2017/06\""));
  EXPECT_EQ(mesh.triangles, tetrahedron);
}

TEST_F(Read3mf, SaysInOneLineWhyAPackageIsRefused) {
  const auto with = [&](const std::string& content) { return file("a.3mf", package(content)); };
  refuses(with(resources(object(1, "model", "2 0 9")) + build(item)), {"3MF", "index"});
  refuses(with(resources(object(1, "model", "2 2 3")) + build(item)), {"3MF", "Indices"});
  refuses(with(resources(object(1, "model", "2 0 3", "nan")) + build(item)), {"3MF", "Coordinates"});
  refuses(with(resources(object(1, "model", "2 0 3", "inf")) + build(item)), {"3MF", "Coordinates"});
  refuses(with(resources(object(1)) + build("<item objectid=\"7\"/>")), {"3MF", "Object"});
  refuses(with(resources(object(1)) + build("")), {"no triangles"});
  refuses(with(resources(object(1)).substr(0, 200)), {"3MF", "build section"});
  refuses(file("unit.3mf", package(resources(object(1)) + build(item), "unit=\"mile\"")), {"unit"});
  refuses(file("empty.3mf", zip_file({})), {"3MF"});
  refuses(file("text.3mf", "solid none\nendsolid\n"), {"no ZIP"});
  const std::string whole = package(resources(object(1)) + build(item));
  for (const std::size_t part : {2, 3, 10})
    refuses(file("cut.3mf", whole.substr(0, whole.size() / part)), {"ZIP"});
}

}  // namespace
}  // namespace kreisel::core
