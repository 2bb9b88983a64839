// far_test.cpp - a model with a map's coordinates: its part is as good as at the origin, and its file holds
// it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_design.hpp"
#include "body/models/geodesic.hpp"
#include "geometry/moved.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/solid.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A top of 40 mm that leans to one side, so that there is something to do.
TriangleMesh lopsided() {
  TriangleMesh mesh = geodesic_sphere(12);
  for (Vec3& v : mesh.vertices) v = 20 * Vec3(v[0] * (v[0] > 0 ? 0.8 : 1), v[1], 0.7 * v[2]);
  return mesh;
}

class Far : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }
  [[nodiscard]] nlohmann::json made(const Vec3& place, const std::string& part,
                                    const std::string& options = "") const {
    write_mesh(file("model.off"), {moved(lopsided(), Eigen::Translation3d(place))});
    // All triangles stay: which of them a shape needs is decided by its last digits.
    const BenchAnswer a =
        design(fmt::format("spin {} -o {} --json {} --resolution 48 --wall 1.6mm --tolerance 0 --force {}",
                           file("model.off"), file(part), file("report.json"), options));
    EXPECT_EQ(a.code, 0) << a.out;
    EXPECT_EQ(a.out.find("nan"), std::string::npos) << a.out;
    return nlohmann::json::parse(std::ifstream(file("report.json")), nullptr, false);
  }

  const TemporaryFolder folder_;
};

constexpr const char* formats[] = {"off", "obj", "ply", "stl", "3mf"};
const Vec3 map = {5e8, -3.5e8, 5e7};

/// What a file's numbers do to the surfaces of a part, mm: floats of up to 40 mm, or of up to 2 m.
constexpr double rounding = 4e-6, rounding_at_2_m = 2.5e-4;

TEST_F(Far, PartIsThatOfTheModelAtTheOriginAndWhereTheModelIs) {
  const nlohmann::json near = made(Vec3::Zero(), "near.off");
  for (const char* format : formats) {
    SCOPED_TRACE(format);
    const std::string part = fmt::format("far.{}", format);
    const nlohmann::json far = made(map, part);
    EXPECT_TRUE(far.at("ok").get<bool>());
    EXPECT_NEAR(far.at("wall_mm").get<double>(), near.at("wall_mm").get<double>(), 1e-3);
    const double mass = near.at("after").at("mass_g").get<double>();
    EXPECT_NEAR(far.at("after").at("mass_g").get<double>(), mass, 1e-4 * mass);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(far.at("after").at("principal_moments_g_mm2")[k].get<double>(),
                  near.at("after").at("principal_moments_g_mm2")[k].get<double>(), 1);
      EXPECT_NEAR(far.at("after").at("centre_of_mass_mm")[k].get<double>() - map[k],
                  near.at("after").at("centre_of_mass_mm")[k].get<double>(), 1e-3);
    }

    const nlohmann::json& by = far.at("moved_mm");
    const Vec3 move(by[0].get<double>(), by[1].get<double>(), by[2].get<double>());
    EXPECT_EQ(move.isZero(0), std::string(format) != "stl") << "all but STL hold any place";
    if (!move.isZero(0)) {
      EXPECT_NE(far.at("after").at("text").get<std::string>().find("moved by -500000000,350000000,"),
                std::string::npos);
    }
    const TriangleMesh mesh = read_mesh(file(part));
    // The middle of the model lies 2 mm from where it was put.
    EXPECT_LE((bounding_box(mesh).centre() - (map + move)).cwiseAbs().maxCoeff(), 2.1);
    const Vec3 size = bounding_box(mesh).extent() - bounding_box(lopsided()).extent();
    EXPECT_LE(size.cwiseAbs().maxCoeff(), 2 * rounding);
    EXPECT_NO_THROW((void)make_solid(mesh, part));
  }
}

TEST_F(Far, StlKeepsAPlaceThatItsNumbersHold) {
  const nlohmann::json report = made({2000, 1400, -200}, "part.stl");
  EXPECT_EQ(report.at("moved_mm"), nlohmann::json({0.0, 0.0, 0.0}));
  EXPECT_NEAR(bounding_box(read_mesh(file("part.stl"))).centre()[0], 2000, 2);
  EXPECT_GE(report.at("wall_mm").get<double>(), report.at("wall_asked_mm").get<double>() - rounding_at_2_m);
}

TEST_F(Far, StlIsMovedFromWhereItsNumbersAreCoarserThanAPrinter) {
  const nlohmann::json report = made({20000, 14000, -2000}, "part.stl");
  EXPECT_EQ(report.at("moved_mm"), nlohmann::json({-19998.0, -14000.0, 2000.0}));
  EXPECT_LE(bounding_box(read_mesh(file("part.stl"))).centre().norm(), 2);
  EXPECT_GE(report.at("wall_mm").get<double>(), report.at("wall_asked_mm").get<double>() - rounding);
}

TEST_F(Far, PiecesOfACutAreSolids) {
  for (const Vec3& place : {Vec3(2000, 1400, -200), map})
    for (const char* cut : {"cut.stl", "cut.3mf"}) {
      const nlohmann::json report = made(place, cut, "--cut auto");
      EXPECT_TRUE(report.at("ok").get<bool>()) << report.at("after").at("text");
      for (const auto& pieces : report.at("files"))
        for (const TriangleMesh& piece : read_objects(pieces.get<std::string>()))
          EXPECT_NO_THROW((void)make_solid(piece, "piece"));
    }
}

TEST_F(Far, PlaneOfACutIsInTheModelsCoordinates) {
  const nlohmann::json report = made(map, "cut.stl", fmt::format("--cut 0,0,1,{}", map[2] + 1.5));
  EXPECT_TRUE(report.at("ok").get<bool>());
  EXPECT_EQ(report.at("files").size(), 2U);
}

TEST_F(Far, PageIsDrawnAboutAPlaceOfTheModel) {
  (void)made(map, "part.stl", "--html " + file("page.html"));
  const std::string page = shell("cat '" + file("page.html") + "'").out;
  EXPECT_NE(page.find("origin = [500000"), std::string::npos);
}

TEST_F(Far, ModelThatSinglePrecisionSpoiledIsRefusedWithTheMoveThatWouldDo) {
  write_mesh(file("model.stl"), {moved(lopsided(), Eigen::Translation3d(map))});
  const BenchAnswer a = bench("inspect " + file("model.stl"));
  EXPECT_EQ(a.code, 2);
  EXPECT_NE(a.out.find("numbers in single precision are 32 apart: move the model by -"), std::string::npos)
      << a.out;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
