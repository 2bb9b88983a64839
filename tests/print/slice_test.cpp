// slice_test.cpp - slicers as they are called, what goes wrong with them, and where the print lies.
#include "print/slice/slice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "geometry/moved.hpp"
#include "installed.hpp"
#include "mesh/io/read.hpp"
#include "mesh/shapes.hpp"
#include "print/gcode/read.hpp"
#include "print/slice/profile.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Profiles, AreKeysAndValues) {
  const SlicerSettings settings =
      parse_profile("# ours\r\nlayer_height = 0.2\n\n; more\nfill_density=15%\nnotes =", "a.ini");
  EXPECT_EQ(settings, (SlicerSettings{{"layer_height", "0.2"}, {"fill_density", "15%"}, {"notes", ""}}));
  EXPECT_EQ(parse_profile(profile_text(settings), "a.ini"), settings);
  expect_refusal([] { (void)parse_profile("a = 1\n[print]\n", "a.ini"); },
                 "a.ini: line 2: ", {"key = value"});
  expect_refusal([] { (void)read_profile("/nowhere.ini"); }, "--profile /nowhere.ini: ", {});
}

TEST(Slicers, ThatCannotBeRunAreToldAhead) {
  expect_refusal([] { (void)Slicer("/nowhere/prusa-slicer"); },
                 "--slicer /nowhere/prusa-slicer: no such program", {"apt-get install prusa-slicer"});
  expect_refusal([] { (void)Slicer("mine --fast"); }, "--slicer mine --fast: no {model}", {"{gcode}"});
  expect_refusal([] { (void)Slicer("nobody {model} {gcode}"); }, "--slicer nobody: no such program", {});
  expect_refusal([] { (void)Slicer(" "); }, "--slicer without a program", {});
}

TEST(Slicers, AreCalledWithoutAShell) {
  const Slicer slicer("sh -c cp\\ x {gcode} --in={model} {profile}");
  EXPECT_EQ(slicer.words({"a b.stl", "c$d.gcode", "p.ini", {}}),
            (std::vector<std::string>{"sh", "-c", "cp x", "c$d.gcode", "--in=a b.stl", "p.ini"}));
}

/// A slicer that does whatever these lines of shell say: $1 the model, $2 the G-code.
std::string script(const TemporaryFolder& folder, const std::string& lines) {
  return fmt::format("sh {} {{model}} {{gcode}}", folder.write("slicer.sh", lines).string());
}

/// The path of a bead around the middle of a cube of 10 mm, in layers.
std::string cube_of_gcode(double x) {
  std::string text = "M83\n";
  for (int layer = 1; layer <= 50; ++layer)
    text += fmt::format("G0 X{0} Y95 Z{2}\nG1 X{1} E1\nG1 Y105 E1\nG1 X{0} E1\nG1 Y95 E1\n", x - 5, x + 5,
                        0.2 * layer);
  return text;
}

Sliced slice(const std::string& slicer, const TriangleMesh& mesh, const Vec3& up = Vec3::UnitZ(),
             double seconds = 600) {
  return MeshSlicer({slicer, {}, seconds})(mesh, up, 1.0, {});
}

TEST(Slicers, TellWhatGoesWrong) {
  const TemporaryFolder folder;
  const TriangleMesh cube = box_mesh({0, 0, 0}, {10, 10, 10});
  const auto refused = [&](const std::string& lines, const std::string& says, double seconds = 60) {
    expect_refusal([&] { (void)slice(script(folder, lines), cube, Vec3::UnitZ(), seconds); }, "--slicer sh ",
                   {says});
  };
  refused("echo no room; exit 7", "code 7 without G-code, expected some; its last words: no room");
  refused("exit 0", "code 0 without G-code");
  refused("sleep 30", "took more than 0.3 s", 0.3);
  folder.write("moved.gcode", cube_of_gcode(120));
  refused(fmt::format("cp {} $2", (folder.path / "moved.gcode").string()), "print lies 20, 0,");
}

TEST(Slicers, AreGivenThePartWhereItWillBePrinted) {
  const TemporaryFolder folder;
  folder.write("cube.gcode", cube_of_gcode(100));
  const std::string kept = (folder.path / "kept.stl").string();
  // On its side, far from where the bed is.
  const TriangleMesh block = box_mesh({1000, -500, 30}, {1010, -490, 40});
  const Sliced sliced =
      slice(script(folder, fmt::format("cp $1 {}; cp {} $2", kept, (folder.path / "cube.gcode").string())),
            block, Vec3::UnitX());
  const Box box = bounding_box(read_mesh(kept).vertices);
  EXPECT_LT((box.lo - Vec3(95, 95, 0)).norm(), 1e-5);
  EXPECT_LT((box.hi - Vec3(105, 105, 10)).norm(), 1e-5);
  const Vec3 centre = sliced.bed_to_model * centre_of_mass(sliced.print.part_mass());
  EXPECT_LT((centre - Vec3(1005, -495, 35)).norm(),
            1e-9);  // all beads are half a layer lower than their paths
  EXPECT_TRUE(std::filesystem::exists(sliced.gcode));
}

/// The corners that the outer walls turn at, of all layers but the first: bed coordinates.
std::vector<Vec3> outer_walls(const std::filesystem::path& gcode, const std::string& type) {
  std::vector<Vec3> corners;
  std::ifstream in(gcode);
  bool outer = false;
  double z = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(";TYPE:")) outer = line == ";TYPE:" + type;
    const auto number = [&](char letter) {
      const std::size_t at = line.find(std::string(" ") + letter);
      return at == std::string::npos ? std::nan("") : std::stod(line.substr(at + 2));
    };
    if (!line.starts_with("G1") && !line.starts_with("G0")) continue;
    line = line.substr(0, line.find(';'));
    if (std::isfinite(number('Z'))) z = number('Z');
    if (outer && line.starts_with("G1") && std::isfinite(number('E')) && std::isfinite(number('X')) &&
        std::isfinite(number('Y')) && z > 0.3)
      corners.emplace_back(number('X'), number('Y'), z);
  }
  return corners;
}

/// A box, turned and moved, is sliced with its own z upward. What the outer walls are in its own coordinates,
/// if bed_to_model is right: a rectangle about its middle, with sides along its edges.
void expect_in_place(const std::string& slicer, const std::string& type) {
  const Vec3 half(10, 15, 5);
  Eigen::Isometry3d lies = Eigen::Isometry3d::Identity();
  lies.linear() = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  lies.translation() = Vec3(40, -70, 12);
  const Sliced sliced = slice(slicer, moved(box_mesh(-half, half), lies), lies.linear().col(2));
  std::vector<Vec3> corners = outer_walls(sliced.gcode, type);
  ASSERT_GT(corners.size(), 100u);
  for (Vec3& corner : corners) corner = lies.inverse() * (sliced.bed_to_model * corner);
  const Box box = bounding_box(corners);
  EXPECT_NEAR(box.centre()[0], 0, 0.01);
  EXPECT_NEAR(box.centre()[1], 0, 0.01);
  EXPECT_NEAR(box.hi[2], half[2], 0.01);        // the nozzle on the last layer
  EXPECT_NEAR(box.hi[0], half[0] - 0.2, 0.06);  // half a width inside
  EXPECT_NEAR(box.hi[1], half[1] - 0.2, 0.06);
  double most = 0;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Vec3 side = corners[k] - corners[k - 1];
    if (side.norm() < 15 || std::abs(side[2]) > 1e-3) continue;
    const Vec3 along = side.normalized().cwiseAbs();
    most = std::max(most, std::min(along[0], along[1]));
  }
  EXPECT_LT(std::asin(most) * 180 / 3.14159265358979, 0.02);
  EXPECT_GT(most, -1.0);
  // And its mass: filled, within what PrusaSlicer adds at walls.
  EXPECT_NEAR(sliced.print.part_volume(), 6000, 0.03 * 6000);
  const Vec3 centre = lies.inverse() * (sliced.bed_to_model * centre_of_mass(sliced.print.part_mass()));
  EXPECT_LT(centre.norm(), 0.15);
}

TEST(Placement, IsThatOfTheOuterWallsOfPrusaSlicer) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  expect_in_place("prusa-slicer", "External perimeter");
}

TEST(Placement, IsThatOfTheOuterWallsOfCuraEngine) {
  // Its definitions of machines are in a package that CI does not install: `apt-get download cura`,
  // `dpkg -x`, and their folder in CURA_ENGINE_SEARCH_PATH do.
  if (!installed("CuraEngine") || (!std::getenv("CURA_ENGINE_SEARCH_PATH") &&
                                   !std::filesystem::exists("/usr/share/cura/resources/definitions")))
    GTEST_SKIP() << "cura-engine, or what it needs of the package cura, is not here";
  expect_in_place("cura-engine", "WALL-OUTER");
}

TEST(Placement, FilamentUsedIsWhatPrusaSlicerSays) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const Sliced sliced = slice("prusa-slicer", box_mesh({0, 0, 0}, {17, 23, 9}));
  const double all = sliced.print.volume([](const PrintGroup&) { return true; });
  ASSERT_TRUE(sliced.print.used_mm.has_value());
  const double area = 3.14159265358979 / 4 * 1.75 * 1.75;
  EXPECT_NEAR(all, *sliced.print.used_mm * area, 1e-3 * all);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
