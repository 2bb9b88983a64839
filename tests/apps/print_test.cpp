// print_test.cpp - parts designed, sliced and balanced, as a user does it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/json_vector.hpp"
#include "apps/run_bench.hpp"
#include "apps/run_design.hpp"
#include "body/mesh_moments.hpp"
#include "installed.hpp"
#include "kreisel/mesh.hpp"
#include "mesh/io/threemf/package.hpp"
#include "mesh/io/threemf/project.hpp"
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
  static std::string bytes_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// From the G-code's coordinates to the model's.
  static Eigen::Matrix<double, 3, 4> motion_of(const json& printed) {
    Eigen::Matrix<double, 3, 4> motion;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        motion(Eigen::Index(r), Eigen::Index(c)) = printed.at("bed_to_model").at(r).at(c).get<double>();
    return motion;
  }
  static double volume(const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value[S1]; }
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
  const Eigen::Matrix<double, 3, 4> motion = motion_of(print);
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

TEST_F(PrintedDesign, HasSparseInfillInPlaceOfVoids) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  answer_ = design(fmt::format(
      "spin ellipsoid --resolution 32 --fineness 12 --infill 15% --balance print --gcode {} -o {} --json {}",
      file("top.gcode"), file("top.3mf"), file("out.json")));
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  EXPECT_NE(answer_.out.find("infill     15 % gyroid in 1 region"), std::string::npos) << answer_.out;
  const json made = report();
  const json& infill = made.at("infill");
  EXPECT_EQ(infill.at("pattern"), "gyroid");
  EXPECT_EQ(infill.at("blocks").size(), 3u);
  const double share = infill.at("share"), region = infill.at("volume_mm3");
  EXPECT_NEAR(share,
              infill.at("bulk_share").get<double>() +
                  infill.at("skin_mm").get<double>() * infill.at("surface_mm2").get<double>() / region,
              0.01);
  EXPECT_EQ(made.at("config").at("infill"), "15%:gyroid");
  EXPECT_FALSE(made.at("config").contains("void-density"));
  // What the file holds, full and sparse, is what was weighed.
  const auto volumes = threemf::read_project({"top.3mf", bytes_of(file("top.3mf"))});
  ASSERT_EQ(volumes.size(), 2u);
  const double all = volume(volumes[0].mesh), sparse = volume(volumes[1].mesh);
  EXPECT_NEAR(sparse, region, 1e-3 * region);
  const double density = made.at("density");
  EXPECT_NEAR(made.at("after").at("mass_g").get<double>(), 1e-3 * density * (all - (1 - share) * sparse),
              1e-3);
  // And the print does it, with about that mass.
  const json& print = made.at("print");
  EXPECT_TRUE(print.at("ok").get<bool>()) << print.at("text");
  EXPECT_EQ(print.at("support_in_voids_mm3"), 0);
  EXPECT_NEAR(print.at("mass_g").get<double>(), made.at("after").at("mass_g").get<double>(),
              0.03 * made.at("after").at("mass_g").get<double>());
  EXPECT_LT(print.at("constraint_residual").at("centre_of_mass_mm").get<double>(), 0.02);
  // Opened without being told anything, the file is sliced to the same: its profile is in it.
  ASSERT_EQ(shell(fmt::format("prusa-slicer --export-gcode --dont-arrange -o {} {}", file("again.gcode"),
                              file("top.3mf")))
                .code,
            0);
  ASSERT_EQ(bench(fmt::format("inspect {} --json {}", file("again.gcode"), file("seen.json"))).code, 0);
  const double again = json::parse(std::ifstream(file("seen.json"))).at("volume_mm3");
  EXPECT_NEAR(again, print.at("volume_mm3").get<double>(), 1e-3 * again);
}

TEST_F(PrintedDesign, IsAProjectForOtherSlicersToo) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  answer_ = design(fmt::format(
      "spin ellipsoid --resolution 32 --fineness 12 --infill 20%:stars --project orca --accept -o {}",
      file("top.3mf")));
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  const auto package = threemf::unpack({"top.3mf", bytes_of(file("top.3mf"))});
  EXPECT_NE(package.at("metadata/model_settings.config").find("tri-hexagon"), std::string::npos);
  EXPECT_EQ(threemf::read_project({"top.3mf", bytes_of(file("top.3mf"))}).size(), 2u);
}

TEST_F(PrintedDesign, TellsWhatSupportsItsVoidsWouldTake) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const json made = top("--accept");
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  const json& print = made.at("print");
  EXPECT_GT(print.at("support_in_voids_mm3").get<double>(), 0);
  EXPECT_GE(print.at("support_everywhere_mm3").get<double>(), print.at("support_in_voids_mm3").get<double>());
  EXPECT_NE(answer_.out.find("--infill 15% leaves no void, --cut auto opens them"), std::string::npos)
      << answer_.out;
}

TEST_F(PrintedDesign, FollowsWhatTheScalesSayOfTheFirst) {
  const auto duck = [&](const std::string& more) {
    answer_ =
        design(fmt::format("float duck --draft 55% --resolution 32 --density 1.2 -o {} --json {} --force {}",
                           file("duck.stl"), file("out.json"), more));
    return report();
  };
  const json first = duck("");
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  const double mass = first.at("after").at("mass_g");
  // What floats may not weigh more than the water that it displaces: a thousandth, says the verdict.
  const json& survives = first.at("survives").at("flow_and_density_percent");
  EXPECT_NEAR(survives.at(0).get<double>(), -0.1, 0.01);
  EXPECT_NEAR(survives.at(1).get<double>(), 0.1, 0.01);
  const json second = duck(fmt::format("--measured-mass {}", 1.03 * mass));
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  EXPECT_NEAR(second.at("weighed").at("expected_g").get<double>(), mass, 1e-6 * mass);
  EXPECT_NEAR(second.at("density").get<double>(), 1.03 * 1.2, 1e-9);
  // It floats as deep as before, so it weighs as much, of less plastic.
  EXPECT_NEAR(second.at("after").at("mass_g").get<double>(), mass, 1e-3 * mass);
  EXPECT_LT(second.at("after").at("volume_mm3").get<double>(),
            first.at("after").at("volume_mm3").get<double>());
  EXPECT_NE(answer_.out.find("weighed "), std::string::npos) << answer_.out;
}

TEST_F(PrintedDesign, OfAYoyoIsTwoHalvesEachOnItsInnerSide) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  answer_ =
      design(fmt::format("yoyo ellipsoid --size 40 --axle 3 --resolution 32 --fineness 12 --slicer "
                         "prusa-slicer --accept --gcode {} -o {} --json {}",
                         file("halves.gcode"), file("halves.stl"), file("out.json")));
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  const json made = report();
  const json& pieces = made.at("print").at("pieces");
  ASSERT_EQ(pieces.size(), 2u);
  const Vec3 axis = vector_of(made.at("axis"));
  // What the G-code of each holds, where the report says that it belongs.
  double all = 0;
  Vec3 first = Vec3::Zero();
  for (const json& piece : pieces) {
    const std::string name = piece.at("name");
    const Eigen::Matrix<double, 3, 4> motion = motion_of(piece);
    EXPECT_NEAR(motion.col(2).dot(axis), name == "upper" ? 1 : -1, 1e-12);
    ASSERT_EQ(bench(fmt::format("inspect {} --json {}", file(("halves-" + name + ".gcode").c_str()),
                                file("seen.json")))
                  .code,
              0);
    const json seen = json::parse(std::ifstream(file("seen.json")));
    const double volume = seen.at("volume_mm3");
    EXPECT_NEAR(volume, piece.at("volume_mm3").get<double>(), 1e-9 * volume);
    all += volume;
    first += volume * (motion.leftCols<3>() * vector_of(seen.at("centre_of_mass_mm")) + motion.col(3));
  }
  // With the axle, which is of the same material and about the origin of the yo-yo, that is the print.
  const double mass = made.at("print").at("mass_g"), density = made.at("density");
  const double axle = 1e3 * mass / density - all;
  EXPECT_GT(axle, 0);
  EXPECT_LT(axle, std::numbers::pi * 3 * 3 * 40) << "a cylinder of that radius, as long as the body";
  const Vec3 centre = (first + axle * vector_of(made.at("contact"))) / (all + axle);
  EXPECT_LT((centre - vector_of(made.at("print").at("centre_of_mass_mm"))).norm(), 1e-6);
  // Prints weigh some per cent more than their meshes: beads overlap along walls.
  EXPECT_NEAR(mass, made.at("after").at("mass_g").get<double>(), 0.05 * mass);
}

TEST_F(PrintedDesign, OfACutPartIsItsPiecesEachOnItsCut) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const json made = top("--size 30 --cut auto --accept");
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  const json& pieces = made.at("print").at("pieces");
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(made.at("print").count("bed_to_model"), 0u);
  for (const char* name : {"top-upper.gcode", "top-lower.gcode"})
    EXPECT_TRUE(std::filesystem::exists(file(name)));
  EXPECT_LT((motion_of(pieces.at(0)).col(2) + motion_of(pieces.at(1)).col(2)).norm(), 1e-12);
  const double mass = made.at("after").at("mass_g");
  EXPECT_NEAR(made.at("print").at("mass_g").get<double>(), mass, 0.06 * mass);
  EXPECT_LT((vector_of(made.at("print").at("centre_of_mass_mm")) -
             vector_of(made.at("after").at("centre_of_mass_mm")))
                .norm(),
            0.3);
}

TEST_F(PrintedDesign, FindsTheWayUpThatNeedsLeastSupportInVoids) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  const json made = top("--size 25 --wall 1 --print-up auto --accept");
  ASSERT_EQ(answer_.code, 0) << answer_.out;
  const json& print = made.at("print");
  const json& tried = print.at("found_up").at("sliced");
  ASSERT_GE(tried.size(), 3u);
  double least = 1e9;
  for (const json& one : tried) least = std::min(least, one.at("support_in_voids_mm3").get<double>());
  EXPECT_LT(least, 0.7 * tried.at(0).at("support_in_voids_mm3").get<double>());
  // The part is printed that way up.
  const Vec3 up = vector_of(print.at("found_up").at("up"));
  EXPECT_LT((motion_of(print).col(2) - up).norm(), 1e-12);
  // Measured again of the part as it was made; a line more or less is a cubic millimetre.
  EXPECT_NEAR(print.at("support_in_voids_mm3").get<double>(), least, 0.02 * least + 1);
}

TEST_F(PrintedDesign, IsRefusedByAPrinterThatIsTooSmall) {
  expect_refused("--printer 'Bambu Lab A1 mini' --size 200", "the part takes 200 x 130 x 127.5 mm");
  expect_refused("--printer 'Bambu Lab A1 mini' --wall 0.7", "less than two lines of its nozzle of 0.4 mm");
  expect_refused("--printer 'Bambu Lab A1 mini@0.3'", "no such nozzle");
  expect_refused("--printer nobodys", "design --printer list");
  const BenchAnswer listed = design("--printer list");
  EXPECT_EQ(listed.code, 0);
  EXPECT_NE(listed.out.find("180 x 180 x 180 mm"), std::string::npos) << listed.out;
}

TEST_F(PrintedDesign, WithInfillIsRefusedInOneLine) {
  expect_refused("--infill 0%", "--infill 0%, expected more than 0 %");
  expect_refused("--infill 100%", "--infill 100%, expected more than 0 % and less than 100 %");
  expect_refused("--infill 15%:girod", "no pattern girod");
  expect_refused("--infill 15%:lightning", "denser in some places");
  expect_refused("--infill 15% --slicer /nowhere/prusa-slicer", "apt-get install prusa-slicer");
  expect_refused("--infill 15% --slicer 'sh {model} {gcode}'", "expected a .3mf file");
  expect_refused("--infill 15% --slicer 'sh {model} {gcode}' --drain 2", "--infill with --drain");
  expect_refused("--project orca", "--infill");
  expect_refused("--measured-mass 2000", "expected what scales say");
}

TEST_F(PrintedDesign, SaysAheadThatItCannotBeSliced) {
  expect_refused("--slicer /nowhere/prusa-slicer", "apt-get install prusa-slicer");
  expect_refused("--slicer 'sh {model} {gcode}' --cut auto --print-up auto",
                 "--print-up auto of a part in pieces");
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
