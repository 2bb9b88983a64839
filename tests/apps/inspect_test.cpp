// inspect_test.cpp - `bench inspect` as a user runs it: good meshes, mended ones, and ones that are no solid.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "mesh/io/write.hpp"
#include "mesh/mesh_folder.hpp"
#include "mesh/shapes.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using nlohmann::json;

class Inspect : public MeshFolder {
 protected:
  /// Writes the mesh, inspects it and reads the JSON back.
  json inspect(const TriangleMesh& mesh, const std::string& options, int code) {
    const std::string model = (folder_ / "part.off").string(), out = (folder_ / "part.json").string();
    write_mesh(model, {mesh});
    answer_ = bench(fmt::format("inspect {} {} --json {}", model, options, out));
    EXPECT_EQ(answer_.code, code) << answer_.out;
    std::ifstream in(out);
    return json::parse(in);
  }
  void says(const std::string& text) const {
    EXPECT_NE(answer_.out.find(text), std::string::npos) << text << " in: " << answer_.out;
  }
  BenchAnswer answer_;
};

/// @param values  an array of three numbers
void expect_near(const json& values, const Vec3& want, double relative) {
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(values.at(k).get<double>(), want[int(k)], relative * want.cwiseAbs().maxCoeff());
}

TEST_F(Inspect, GivesMassPropertiesInClosedFormForABox) {
  const json j = inspect(box_mesh({1, 2, 3}, {11, 22, 33}), "--density 2", 0);
  EXPECT_TRUE(j.at("error").is_null());
  EXPECT_EQ(j.at("format"), "OFF");
  EXPECT_EQ(j.at("triangles"), 12);
  EXPECT_EQ(j.at("shells").size(), 1u);
  EXPECT_EQ(j.at("shells").at(0).at("genus"), 0);
  // 10 x 20 x 30 mm of 2 g/cm^3: 12 g; m (b^2 + c^2) / 12 about each axis. Tolerance: device sums in double.
  const json& solid = j.at("solid");
  EXPECT_NEAR(solid.at("volume_mm3").get<double>(), 6000, 1e-9 * 6000);
  EXPECT_NEAR(solid.at("mass_g").get<double>(), 12, 1e-9 * 12);
  expect_near(solid.at("extent_mm"), {10, 20, 30}, 1e-12);
  expect_near(solid.at("centre_of_mass_mm"), {6, 12, 18}, 1e-9);
  expect_near(solid.at("principal_moments_g_mm2"), {500, 1000, 1300}, 1e-9);
  EXPECT_NEAR(std::abs(solid.at("principal_axes").at(0).at(2).get<double>()), 1, 1e-9);  // longest: z
  EXPECT_FALSE(solid.at("verified").at("spin").at("ok"));                                // a tall box
  says("genus 0");
  says("repairs    none");
}

TEST_F(Inspect, ScalesBySize) {
  const json j = inspect(box_mesh({0, 0, 0}, {1, 2, 3}), "--size 30", 0);
  EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 6000, 1e-9 * 6000);
}

TEST_F(Inspect, TakesAFilesLengthsInTheGivenUnit) {
  const json j = inspect(box_mesh({0, 0, 0}, {1, 2, 3}), "--unit cm --density 2", 0);
  EXPECT_NEAR(j.at("solid").at("mass_g").get<double>(), 12, 1e-9 * 12);
  EXPECT_NEAR(j.at("shells").at(0).at("volume").get<double>(), 6, 1e-12) << "in the file's unit";
}

TEST_F(Inspect, ReportsRepairsAndCavities) {
  const TriangleMesh hollow = both(box_mesh({0, 0, 0}, {3, 3, 3}), inverted(box_mesh({1, 1, 1}, {2, 2, 2})));
  const json j = inspect(inverted(soup(hollow)), "", 0);
  EXPECT_EQ(j.at("repairs"), json({"merged 56 equal vertices", "turned 2 inside-out shells",
                                   "kept 1 cavity, a shell inside the solid that faces inward"}));
  EXPECT_EQ(j.at("checks").at("equal_vertices"), 56);
  EXPECT_EQ(j.at("shells").at(1).at("depth"), 1);
  EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 26, 1e-9 * 26);
  says("repaired   merged 56 equal vertices");
}

TEST_F(Inspect, UnitesWhatOverlapsAndSaysSo) {
  const json j =
      inspect(both(box_mesh({0, 0, 0}, {3, 3, 3}), box_mesh({1, 1, 2}, {2, 2, 4})), "--size 40", 0);
  EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 28e3, 1e-9 * 28e3);
  EXPECT_GT(j.at("checks").at("self_intersections"), 0);
  EXPECT_EQ(j.at("shells").size(), 2u);
  ASSERT_EQ(j.at("solid").at("pieces_g").size(), 1u);
  EXPECT_NEAR(j.at("solid").at("pieces_g").at(0).get<double>(), 28, 1e-9);
  says("united what overlaps: ");
}

TEST_F(Inspect, AsksWhatIsEnclosedInsideOut) {
  const TriangleMesh mesh = both(box_mesh({0, 0, 0}, {3, 3, 3}), inverted(box_mesh({1, 1, 2}, {2, 2, 5})));
  json j = inspect(mesh, "", 2);
  EXPECT_TRUE(j.at("solid").is_null());
  EXPECT_NE(j.at("error").get<std::string>().find("2 mm^3 are enclosed inside out"), std::string::npos);
  j = inspect(mesh, "--inside-out void", 0);
  EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 26, 1e-9);
  j = inspect(mesh, "--inside-out solid", 0);
  EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 28, 1e-9);
  (void)inspect(mesh, "--inside-out full", 2);
  says("expected solid or void");
}

TEST_F(Inspect, ClosesHolesWhenItIsAsked) {
  TriangleMesh open = box_mesh({0, 0, 0}, {2, 2, 2});
  open.triangles.pop_back();
  (void)inspect(open, "--close-holes 2.8", 2);
  says("open edges: 3");
  for (const char* asked : {"--close-holes 2.9", "--close-holes all", "--close-holes"}) {
    const json j = inspect(open, asked, 0);
    EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 8, 1e-9);
    says("closed 1 hole");
  }
  (void)inspect(open, "--close-holes 0", 2);
  says("more than 0 mm");
}

TEST_F(Inspect, WeighsPiecesOfWhichASolveTakesOne) {
  const TriangleMesh mesh = both(box_mesh({0, 0, 0}, {10, 10, 10}), box_mesh({20, 0, 0}, {26, 10, 10}));
  json j = inspect(mesh, "", 0);
  EXPECT_EQ(j.at("solid").at("pieces_g").size(), 2u);
  EXPECT_NEAR(j.at("solid").at("pieces_g").at(1).get<double>(), 0.6, 1e-9);
  says("pieces     2 that do not touch: 1, 0.6 g");
  j = inspect(mesh, "--pieces 2", 0);
  EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 600, 1e-9);
  (void)inspect(mesh, "--pieces 3", 2);
  says("expected 1 to 2");
  const std::string file = (folder_ / "pieces.off").string();
  write_mesh(file, {mesh});
  BenchAnswer a = bench(fmt::format("--problem stand --model '{}' --resolution 16", file));
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find("2 pieces that do not touch, no rigid body: 1 of 1 g, 2 of 0.6 g"), std::string::npos)
      << a.out;
  a = bench(fmt::format("--problem stand --model '{}' --resolution 16 --pieces largest", file));
  EXPECT_EQ(a.code, 0) << a.out;
}

TEST_F(Inspect, SaysAllItCanOfAnOpenSurface) {
  TriangleMesh open = box_mesh({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  const json j = inspect(open, "", 2);
  EXPECT_EQ(j.at("checks").at("open_edges"), 3);
  EXPECT_FALSE(j.at("shells").at(0).at("closed"));
  EXPECT_TRUE(j.at("shells").at(0).at("genus").is_null());
  says("open edges: 3");
}

TEST_F(Inspect, TakesAModelByNameAndJsonOnStandardOutput) {
  const BenchAnswer a = bench("inspect ellipsoid --fineness 8 --json -");
  EXPECT_EQ(a.code, 0) << a.out;
  EXPECT_EQ(json::parse(a.out).at("format"), "parametric model");
}

TEST_F(Inspect, WeldsCornersAtOpenEdgesWithinTheGivenDistance) {
  // Inches: a corner of one triangle is 0.001 from the others', which is 0.0254 mm.
  TriangleMesh mesh = soup(box_mesh({0, 0, 0}, {1, 2, 3}));
  mesh.vertices[0] += Vec3(0.0006, 0.0008, 0);
  json j = inspect(mesh, "--unit in", 2);
  says("open edges");
  (void)inspect(mesh, "--unit in --weld 0.0253", 2);
  j = inspect(mesh, "--unit in --weld 0.0255", 0);
  says("welded 1 vertex to another at open edges, no more than 0.001 apart");
  EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 6 * 25.4 * 25.4 * 25.4, 0.01 * 1e5);
}

TEST_F(Inspect, WeldsByTheDigitsOfTheFileUnlessToldNotTo) {
  TriangleMesh mesh = soup(box_mesh({0, 0, 0}, {1, 2, 3}));
  mesh.vertices[0] += Vec3(2e-16, 0, 0);  // written as 2e-16: the file has no more than six digits elsewhere
  const json j = inspect(mesh, "", 0);
  EXPECT_NEAR(j.at("solid").at("volume_mm3").get<double>(), 6, 1e-9);
  says("welded 1 vertex");
  (void)inspect(mesh, "--weld 0", 2);
  says("open edges");
}

TEST_F(Inspect, TakesFileNamesInAnyBytes) {
  const std::string model = (folder_ /
                             "gr\xf6\xdf"
                             "e.off")
                                .string(),
                    out = (folder_ / "out.json").string();
  write_mesh(model, {box_mesh({0, 0, 0}, {1, 2, 3})});
  EXPECT_EQ(bench(fmt::format("inspect '{}' --json '{}'", model, out)).code, 0);
  std::ifstream in(out);
  EXPECT_NE(json::parse(in).at("model").get<std::string>().find("gr\xef\xbf\xbd\xef\xbf\xbd"
                                                                "e.off"),
            std::string::npos);
  EXPECT_EQ(json::parse(bench(fmt::format("inspect '{}' --json -", model)).out).at("triangles"), 12);
}

TEST_F(Inspect, RefusesWhatIsNoMeshInOneLine) {
  for (const std::string name : {"absent.stl", "absent", "empty.ply"}) {
    (void)file("empty.ply", "");
    const BenchAnswer a = bench(fmt::format("inspect {}", (folder_ / name).string()));
    EXPECT_EQ(a.code, 2);
    EXPECT_EQ(std::count(a.out.begin(), a.out.end(), '\n'), 1) << a.out;
    EXPECT_NE(a.out.find("expected"), std::string::npos) << a.out;
  }
  EXPECT_EQ(bench("inspect").code, 2);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
