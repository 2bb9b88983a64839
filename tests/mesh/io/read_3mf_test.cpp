#include "mesh/io/read_3mf.hpp"

#include <gtest/gtest.h>

#include "mesh/mesh_folder.hpp"
#include "mesh/threemf_package.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using namespace threemf_package;

class Read3mf : public MeshFolder {};

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
  for (const std::string x : {"nan", "inf", "20,5", "", "0x1", "1 2"})
    refuses(with(resources(object(1, "model", "2 0 3", x)) + build(item)),
            {"3MF", "line 1", "'" + x + "'", "vertex 4"});
  refuses(with(resources(object(1)) + build("<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0\"/>")),
          {"transform '1 0 0 0 1 0 0 0 1 0 0'", "12"});
  refuses(with(resources(object(1)) + build("<item objectid=\"7\"/>")), {"3MF", "Object"});
  refuses(with(resources(object(1)) + build("")), {"no triangles"});
  refuses(with(resources(object(1)).substr(0, 200)), {"3MF", "line 1", "well-formed"});
  refuses(file("unit.3mf", package(resources(object(1)) + build(item), "unit=\"mile\"")), {"unit"});
  refuses(file("empty.3mf", zip_file({})), {"3MF"});
  refuses(file("text.3mf", "solid none\nendsolid\n"), {"no ZIP"});
  const std::string whole = package(resources(object(1)) + build(item));
  for (const std::size_t part : {2, 3, 10})
    refuses(file("cut.3mf", whole.substr(0, whole.size() / part)), {"ZIP"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
