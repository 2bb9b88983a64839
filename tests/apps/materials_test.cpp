// materials_test.cpp - two materials, voids and the plane sweep as a user runs them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "body/test_meshes.hpp"
#include "mesh/io/write.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A box of 60 x 40 x 30 mm that is to balance 7 mm beside its middle. With walls of 3.75 mm a little over
/// half of it can be hollowed: that moves the centre of mass by less than 5 mm, by hand, and by 6.5 in
/// columns of 2.5 mm.
class TwoMaterials : public testing::Test {
 protected:
  TwoMaterials() { write_mesh(folder_.path / "box.off", {box_mesh({0, 0, 0}, {60, 40, 30})}); }

  [[nodiscard]] BenchAnswer balance(const std::string& more) const {
    return bench(
        fmt::format("--model '{0}/box.off' --problem balance --point 37,20,15 --density 1.17 "
                    "--resolution 24 --json '{0}/run.json' {1}",
                    folder_.path.string(), more));
  }
  [[nodiscard]] nlohmann::json json() const {
    std::ifstream in(folder_.path / "run.json");
    return nlohmann::json::parse(in, nullptr, false);
  }
  [[nodiscard]] bool has(const char* file) const { return std::filesystem::exists(folder_.path / file); }
  [[nodiscard]] std::string at(const char* file) const { return (folder_.path / file).string(); }

  const TemporaryFolder folder_;
};

TEST_F(TwoMaterials, MeetWhatHollowingCannotAndTheAnswerSaysHow) {
  const BenchAnswer hollow = balance("--formulation quadric");
  EXPECT_EQ(hollow.code, 3) << hollow.out;
  EXPECT_NE(hollow.out.find("--interior-density"), std::string::npos) << hollow.out;
  EXPECT_NE(hollow.out.find("--void-density"), std::string::npos) << hollow.out;

  // A heavy interior with voids in it; then heavy parts in place of voids.
  for (const char* const densities : {"--interior-density 8.1", "--void-density 8.1"})
    for (const char* const formulation : {"quadric", "rayrep", "voxel", "octree"}) {
      const BenchAnswer a =
          balance(fmt::format("{} --formulation {} --mesh '{}'", densities, formulation, at("part.stl")));
      EXPECT_EQ(a.code, 0) << a.out;
      const nlohmann::json j = json();
      const nlohmann::json& verified = j.at("verified");
      EXPECT_TRUE(verified.at("ok").get<bool>()) << formulation << a.out;
      EXPECT_LE(verified.at("rounding_mismatch").get<double>(), 1e-5) << "single precision of STL";
      double grams = 0;
      for (const nlohmann::json& material : verified.at("materials"))
        grams += material.at("mass_g").get<double>();
      EXPECT_EQ(verified.at("materials").size(), 2u);
      EXPECT_NEAR(grams, j.at("moments").at(0).get<double>(), 1e-4 * grams);
      if (std::string(formulation) == "voxel") {
        EXPECT_NE(a.out.find("part-"), std::string::npos) << a.out;
      }
    }
  EXPECT_TRUE(has("part.stl") && has("part-interior.stl") && has("part-filling.stl"));
}

TEST_F(TwoMaterials, AreCertifiedAndTheCheckOfTheProofAgrees) {
  const BenchAnswer a = balance(
      fmt::format("--interior-density 8.1 --void-density 0.5 --formulation quadric --certify --record '{}' "
                  "--mesh '{}'",
                  at("run.h5"), at("part.3mf")));
  EXPECT_EQ(a.code, 0) << a.out;
  EXPECT_LE(json().at("gap").get<double>(), 1e-3) << a.out;
  EXPECT_NE(a.out.find("part.3mf: filling of 0.5 g/cm^3"), std::string::npos) << a.out;
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0) return;
  for (const char* const script : {"plots/check_certificate.py", "tests/record/h5py_test.py"}) {
    const BenchAnswer check =
        shell(fmt::format("/usr/bin/python3 '{}/{}' '{}'", source_folder, script, at("run.h5")));
    EXPECT_EQ(check.code, 0) << script << check.out;
  }
}

TEST_F(TwoMaterials, HaveVoidsThatAreCountedAndCut) {
  ASSERT_EQ(
      bench(fmt::format("--model '{0}/box.off' --problem stand --resolution 24 --formulation quadric --json "
                        "'{0}/run.json'",
                        folder_.path.string()))
          .code,
      0);
  // The lowest centre of mass of a box: the upper part of its interior is one void.
  const nlohmann::json j = json();
  EXPECT_EQ(j.at("voids").size(), 1u);
  EXPECT_EQ(j.at("islands").size(), 0u);
  ASSERT_EQ(j.at("cuts").size(), 1u);
  EXPECT_EQ(j.at("cuts").at(0).at("opens"), 1);
}

TEST_F(TwoMaterials, StandByThePlaneSweepHigherThanTheyCould) {
  const std::string run = fmt::format(
      "--model duck --problem stand --set problem.base=1% --wall 5% --resolution 32 --formulation voxel "
      "--json '{}' ",
      at("run.json"));
  const BenchAnswer swept = bench(run + "--solver plane-sweep");
  EXPECT_EQ(swept.code, 0) << swept.out;
  EXPECT_EQ(json().at("termination"), "acceptable");
  EXPECT_LE(json().at("verified").at("off_centroid_mm").get<double>(), 0.05);
  const double height = json().at("verified").at("height_share").get<double>();
  EXPECT_EQ(bench(run).code, 0);
  EXPECT_LT(json().at("verified").at("height_share").get<double>(), height);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
