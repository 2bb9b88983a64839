// inspect_gcode_test.cpp - `bench inspect` of G-code as a user runs it, and beside what slicers say
// themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/json_vector.hpp"
#include "apps/run_bench.hpp"
#include "installed.hpp"
#include "kreisel/mesh.hpp"
#include "mesh/io/write.hpp"
#include "mesh/shapes.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using nlohmann::json;

class InspectGcode : public ::testing::Test {
 protected:
  json inspect(const std::string& arguments) {
    const std::string out = (folder.path / "out.json").string();
    answer = bench(fmt::format("inspect {} --json {}", arguments, out));
    EXPECT_EQ(answer.code, 0) << answer.out;
    return json::parse(std::ifstream(out), nullptr, false);
  }
  void expect_refused(const BenchAnswer& refused, const std::string& says) {
    EXPECT_EQ(refused.code, 2) << refused.out;
    EXPECT_NE(refused.out.find(says), std::string::npos) << refused.out;
    EXPECT_EQ(std::count(refused.out.begin(), refused.out.end(), '\n'), 1) << refused.out;
  }
  std::string write(const std::string& name, const std::string& text) {
    return folder.write(name, text).string();
  }

  TemporaryFolder folder;
  BenchAnswer answer;
};

/// A ring of 20 mm radius about that point, as high as it is wide: a wheel that spins. 8 mm^3 of E.
std::string ring(double x, double y) { return fmt::format("G0 X{} Y{} Z.2\nG2 I-20 E8\n", x + 20, y); }

TEST_F(InspectGcode, ARingIsInspectedInClosedForm) {
  const json j = inspect(write("ring.gcode", "M83\n" + ring(50, 60)) + " --density 2 --filament 3");
  const double volume = 8 * std::numbers::pi / 4 * 9, width = volume / (2 * std::numbers::pi * 20 * 0.2);
  EXPECT_NEAR(j.at("volume_mm3").get<double>(), volume, 1e-9 * volume);
  EXPECT_NEAR(j.at("mass_g").get<double>(), 2e-3 * volume, 1e-9 * volume);
  EXPECT_LT((vector_of(j.at("centre_of_mass_mm")) - Vec3(50, 60, 0.1)).norm(), 1e-9);
  const double polar = 2e-3 * volume * (400 + width * width / 4);
  EXPECT_NEAR(j.at("inertia_g_mm2").at(2).at(2).get<double>(), polar, 1e-9 * polar);
  EXPECT_NEAR(j.at("principal_moments_g_mm2").at(2).get<double>(), polar, 1e-9 * polar);
  EXPECT_TRUE(j.at("verified").at("spin").at("ok").get<bool>()) << j.at("verified");
  EXPECT_NE(answer.out.find("spin       yes"), std::string::npos) << answer.out;
  // About another axis it does not.
  const json off = inspect(write("ring.gcode", "M83\n" + ring(50, 60)) + " --problem spin --contact 51,60,0");
  EXPECT_FALSE(off.at("verified").at("spin").at("ok").get<bool>());
  EXPECT_NEAR(off.at("verified").at("spin").at("values").at("off_axis_mm").get<double>(), 1, 1e-9);
}

TEST_F(InspectGcode, ObjectsAreBodiesOfTheirOwn) {
  const json j = inspect(
      write("two.gcode", "M83\nM486 S0\n" + ring(50, 60) + "M486 S1\n" + ring(150, 60) + "M486 S-1\n"));
  ASSERT_EQ(j.at("objects").size(), 2u);
  EXPECT_TRUE(j.at("verified").empty());
  for (const json& object : j.at("objects"))
    EXPECT_TRUE(object.at("verified").at("spin").at("ok").get<bool>());
  EXPECT_LT((vector_of(j.at("objects").at(1).at("centre_of_mass_mm")) - Vec3(150, 60, 0.1)).norm(), 1e-9);
  EXPECT_LT((vector_of(j.at("centre_of_mass_mm")) - Vec3(100, 60, 0.1)).norm(), 1e-9);
}

TEST_F(InspectGcode, WhatMakesNoSenseIsRefused) {
  const std::string file = write("ring.gcode", "M83\n" + ring(50, 60));
  expect_refused(bench("inspect " + file + " --size 60"), "--size of G-code");
  expect_refused(bench("inspect " + file + " --problem stand"), "needs a surface");
  expect_refused(bench("inspect ellipsoid --problem spin"), "are for G-code");
  expect_refused(bench("inspect " + write("bad.gcode", "M83\nG1 Xnan E1\n")), "bad.gcode: line 2: 'Xnan'");
  expect_refused(bench("inspect /nowhere.gcode"), "/nowhere.gcode: No such file");
}

/// PrusaSlicer, Slic3r and CuraEngine each slice a box by their own settings. All that they extrude is what
/// they say.
TEST_F(InspectGcode, FilamentIsWhatSlicersSay) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const std::string stl = (folder.path / "box.stl").string(), gcode = (folder.path / "box.gcode").string();
  write_mesh(stl, {box_mesh({0, 0, 0}, {20, 30, 10})});
  for (const char* options :
       {"", "--use-relative-e-distances --skirts 3 --brim-width 4", "--use-firmware-retraction",
        "--fill-density 100% --fill-pattern rectilinear --spiral-vase=0 --support-material",
        "--gcode-comments --retract-restart-extra 0.05", "--filament-diameter 2.85 --raft-layers 2"}) {
    ASSERT_EQ(shell(fmt::format("prusa-slicer --export-gcode {} -o {} {}", options, gcode, stl)).code, 0);
    const json j = inspect(gcode);
    const double d = j.at("filaments").at(0).at("diameter_mm");
    const double said = j.at("filament_used_mm").get<double>() * std::numbers::pi / 4 * d * d;
    EXPECT_NEAR(j.at("volume_of_all_mm3").get<double>(), said, 1e-3 * said) << options;
    EXPECT_LT(j.at("volume_mm3").get<double>(), j.at("volume_of_all_mm3").get<double>()) << options;
  }
  // Filled, the part weighs what the box does: slicers add a little where walls meet infill.
  ASSERT_EQ(shell(fmt::format("prusa-slicer --export-gcode --fill-density 100% --fill-pattern rectilinear "
                              "--first-layer-height 0.2 --layer-height 0.2 -o {} {}",
                              gcode, stl))
                .code,
            0);
  const json full = inspect(gcode);
  EXPECT_NEAR(full.at("volume_mm3").get<double>(), 6000, 60);
  EXPECT_NEAR(full.at("centre_of_mass_mm").at(2).get<double>(), 5, 0.05);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
