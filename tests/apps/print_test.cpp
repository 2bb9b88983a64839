// print_test.cpp - parts designed, sliced and balanced, as a user does it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/json_vector.hpp"
#include "apps/run_bench.hpp"
#include "apps/run_design.hpp"
#include "installed.hpp"
#include "kreisel/mesh.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using nlohmann::json;

class PrintedDesign : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const char* name) const { return (folder_.path / name).string(); }
  [[nodiscard]] json report() const { return json::parse(std::ifstream(file("out.json")), nullptr, false); }
  /// A coarse top, sliced; its report.
  json top(const std::string& more) {
    answer_ = design(fmt::format(
        "spin ellipsoid --resolution 32 --fineness 12 --slicer prusa-slicer --gcode {} -o {} --json {} "
        "--force {}",
        file("top.gcode"), file("top.stl"), file("out.json"), more));
    return report();
  }
  void expect_refused(const std::string& options, const std::string& says) {
    const BenchAnswer refused = design(fmt::format("spin ellipsoid -o {} {}", file("top.stl"), options));
    EXPECT_EQ(refused.code, 2) << refused.out;
    EXPECT_NE(refused.out.find(says), std::string::npos) << refused.out;
    EXPECT_EQ(std::count(refused.out.begin(), refused.out.end(), '\n'), 1) << refused.out;
    EXPECT_FALSE(std::filesystem::exists(file("top.stl")));
  }

  TemporaryFolder folder_;
  BenchAnswer answer_{};
};

TEST_F(PrintedDesign, IsThatOfItsGcodeAndOfThePlaceItWasLaidAt) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const json made = top("--accept");
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  EXPECT_NE(answer_.out.find(" print\n"), std::string::npos) << answer_.out;
  const json& print = made.at("print");
  EXPECT_NE(print.at("slicer").get<std::string>().find("PrusaSlicer"), std::string::npos);
  EXPECT_EQ(print.at("settings").at("layer_height"), "0.2");
  EXPECT_EQ(print.at("rounds").size(), 1u);
  // The G-code that was kept, on its own: the same mass, its centre where the motion takes it.
  ASSERT_EQ(bench(fmt::format("inspect {} --json {}", file("top.gcode"), file("out.json"))).code, 0);
  const json seen = report();
  const double volume = print.at("volume_mm3");
  EXPECT_NEAR(seen.at("volume_mm3").get<double>(), volume, 1e-9 * volume);
  Eigen::Matrix<double, 3, 4> motion;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      motion(r, c) = print.at("bed_to_model").at(std::size_t(r)).at(std::size_t(c)).get<double>();
  const Eigen::Matrix3d turn = motion.leftCols<3>();
  EXPECT_LT((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(turn.determinant(), 1, 1e-12);
  const Vec3 centre = turn * vector_of(seen.at("centre_of_mass_mm")) + motion.col(3);
  EXPECT_LT((centre - vector_of(print.at("centre_of_mass_mm"))).norm(), 1e-9);
  // Near the mesh's: a print is no other thing.
  EXPECT_LT((centre - vector_of(made.at("after").at("centre_of_mass_mm"))).norm(), 0.3);
}

TEST_F(PrintedDesign, BalancesWhereItsMeshAloneDidNot) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const json made = top("--balance print");
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  const json& print = made.at("print");
  EXPECT_TRUE(print.at("ok").get<bool>()) << print.at("text");
  const json& rounds = print.at("rounds");
  ASSERT_GT(rounds.size(), 1u);
  // The first round is the part that meets it as a mesh; what is kept is better.
  const json& kept = print.at("constraint_residual");
  EXPECT_LT(kept.at("axis_degrees").get<double>(), 0.5 * rounds.at(0).at("axis_degrees").get<double>());
  EXPECT_LT(kept.at("centre_of_mass_mm").get<double>(),
            0.5 * rounds.at(0).at("centre_of_mass_mm").get<double>());
}

TEST_F(PrintedDesign, SaysAheadThatItCannotBeSliced) {
  expect_refused("--slicer /nowhere/prusa-slicer", "apt-get install prusa-slicer");
  expect_refused("--slicer 'sh {model} {gcode}' --cut auto", "--slicer of a part that is cut");
  expect_refused("--slicer 'sh {model} {gcode}' --print-up 0,0,0", "--print-up 0,0,0");
  expect_refused("--slicer 'sh {model} {gcode}' --profile /nowhere.ini", "--profile /nowhere.ini");
  expect_refused("--slicer 'sh {model} {gcode}' --balance print --formulation voxel",
                 "--balance print of voxel");
  expect_refused("--slicer 'sh {model} {gcode}' --void-density 0.2",
                 "--slicer of a part of several materials");
  expect_refused("--balance print", "--slicer");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
