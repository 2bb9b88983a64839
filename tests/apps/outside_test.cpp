// outside_test.cpp - what PrusaSlicer, admesh and CGAL say of the parts that `design` writes. What is not
// installed is skipped, but not in CI. Their exit codes say little: what they print is read.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "apps/run_design.hpp"
#include "installed.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// The number behind `name` and blanks or '='; NaN without one.
double number_after(const std::string& name, const std::string& text) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(name + R"([ =:]+([-+.0-9eE]+))"))) return std::nan("");
  return std::stod(found[1]);
}

/// A part for each problem, pieces of cuts, and a nested doll; made once for all tests.
class Outside : public ::testing::Test {
 protected:
  struct Part {
    std::string file;
    double volume, triangles;  ///< as reported; NaN where only those of all pieces together are
  };

  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryFolder>();
    const nlohmann::json top = make("spin ellipsoid --resolution 40 --fineness 24", "top"),
                         duck = make("float duck --draft 50% --resolution 40 --fineness 24", "duck");
    for (const nlohmann::json& whole : {top, duck})
      parts.push_back({whole.at("files")[0], whole.at("after").at("volume_mm3"), whole.at("triangles")});
    for (const nlohmann::json& cut :
         {make("spin ellipsoid --resolution 40 --fineness 24 --cut auto --pegs 1", "halves"),
          make("float duck --draft 50% --resolution 40 --fineness 24 --cut 0.3,0.2,0.9,14", "pieces"),
          make("float duck --draft 50% --resolution 40 --fineness 24 --cut 0.3,0.2,0.9,14 --lay-flat",
               "flat")})
      for (const auto& file : cut.at("files")) parts.push_back({file, std::nan(""), std::nan("")});
    const nlohmann::json cast = make(
        "spin ellipsoid --resolution 40 --fineness 24 --density 1.17 --interior-density 8.1 --mould", "cast");
    for (const auto& file : cast.at("moulds")[0].at("files")) {
      parts.push_back({file, std::nan(""), std::nan("")});
      moulds.push_back(file);
    }
    const nlohmann::json doll = make(
        "nest duck --fineness 16 --particles 24 --iterations 8 --cells 64 --printer-accuracy 0.8", "doll");
    for (const auto& part : doll.at("parts"))
      parts.push_back({part.at("file"), part.at("volume_mm3"), part.at("triangles")});
  }
  static nlohmann::json make(const std::string& arguments, const std::string& name) {
    const std::string stl = (folder->path / name).string() + ".stl", json = stl + ".json";
    const BenchAnswer a = design(fmt::format("{} -o {} --json {}", arguments, stl, json));
    EXPECT_EQ(a.code, 0) << a.out;
    return nlohmann::json::parse(std::ifstream(json), nullptr, false);
  }
  static void TearDownTestSuite() {
    parts.clear();
    moulds.clear();
    folder.reset();
  }

  static std::unique_ptr<TemporaryFolder> folder;
  static std::vector<Part> parts;
  static std::vector<std::string> moulds;
};

std::unique_ptr<TemporaryFolder> Outside::folder;
std::vector<Outside::Part> Outside::parts;
std::vector<std::string> Outside::moulds;

void expect_slices(const std::string& file, const std::string& options) {
  const std::string gcode = file + ".gcode";
  const std::string said =
      shell(fmt::format("prusa-slicer --export-gcode --layer-height 0.3 {} -o {} {}", options, gcode, file))
          .out;
  ASSERT_TRUE(std::filesystem::exists(gcode)) << said;
  EXPECT_GT(std::filesystem::file_size(gcode), 10000u) << said;
}

TEST_F(Outside, PrusaSlicerSaysManifoldAndTheSameVolume) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  for (const Part& part : parts) {
    const std::string said = shell(fmt::format("prusa-slicer --info {}", part.file)).out;
    EXPECT_NE(said.find("manifold = yes"), std::string::npos) << said;
    EXPECT_EQ(said.find("open_edges"), std::string::npos) << said;
    EXPECT_EQ(said.find("facets_reversed"), std::string::npos) << said;
    // Single precision; a cavity that faced outward would add.
    if (std::isfinite(part.volume)) {
      EXPECT_NEAR(number_after("volume", said), part.volume, 1e-4 * part.volume) << said;
    }
  }
}

TEST_F(Outside, PrusaSlicerSlicesATop) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  expect_slices(parts.front().file, "--support-material");
}

TEST_F(Outside, PrusaSlicerSlicesAMould) {
  KREISEL_NEEDS(installed("prusa-slicer"), "prusa-slicer");
  ASSERT_EQ(moulds.size(), 4u);
  for (const std::string& file : moulds) expect_slices(file, "");
}

TEST_F(Outside, AdmeshFindsNothingToMend) {
  KREISEL_NEEDS(installed("admesh"), "admesh");
  for (const Part& part : parts) {
    const std::string said = shell(fmt::format("admesh {}", part.file)).out;
    for (const char* fault : {"Degenerate facets", "Edges fixed", "Facets removed", "Facets added",
                              "Facets reversed", "Backwards edges"})
      EXPECT_EQ(number_after(fault, said), 0) << fault << '\n' << said;
    if (std::isfinite(part.volume)) {
      EXPECT_NEAR(number_after("Volume", said), part.volume, 1e-4 * part.volume) << said;
    }
  }
}

TEST_F(Outside, CgalFindsASurfaceThatBoundsAVolumeAndDoesNotRunThroughItself) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "not built with sanitizers";
#endif
  KREISEL_NEEDS(std::filesystem::exists(cgal_check_program), "cgal_check");
  for (const Part& part : parts) {
    const std::string said = shell(fmt::format("'{}' {}", cgal_check_program, part.file)).out;
    EXPECT_NE(said.find("closed 1 self_intersects 0 bounds_volume 1"), std::string::npos) << said;
    if (!std::isfinite(part.volume)) continue;
    EXPECT_EQ(number_after("triangles", said), part.triangles);
    EXPECT_NEAR(number_after("bounds_volume [01] volume", said), part.volume, 1e-6 * part.volume) << said;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
