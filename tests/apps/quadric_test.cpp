// quadric_test.cpp - the quadric as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class QuadricRun : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }
  [[nodiscard]] nlohmann::json json() const {
    std::ifstream in(file("run.json"));
    return nlohmann::json::parse(in, nullptr, false);
  }

  const TemporaryFolder folder_;
};

TEST_F(QuadricRun, MeshesASmoothCavityThatMeetsTheConstraints) {
  const BenchAnswer a = bench(
      fmt::format("--formulation quadric --resolution 40 --fineness 24 --json '{}' --record '{}' --mesh '{}'",
                  file("run.json"), file("run.h5"), file("part.stl")));
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("a smooth cavity of"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("verified   spins:"), std::string::npos) << a.out;
  const nlohmann::json j = json();
  EXPECT_EQ(j.at("domain"), "exact");
  EXPECT_EQ(j.at("solver"), "moment");
  EXPECT_EQ(j.at("variables"), 10);
  EXPECT_LE(j.at("constraint_violation").get<double>(), 1e-12);
  // The solver's tolerance for the mesh, a thousandth of what a verdict asks for; STL rounds below that.
  EXPECT_LE(j.at("verified").at("off_axis").get<double>(), 2e-6);
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0) return;
  EXPECT_EQ(shell(fmt::format("/usr/bin/python3 '{}/tests/record/h5py_test.py' '{}'", source_folder,
                              file("run.h5")))
                .code,
            0);
}

TEST_F(QuadricRun, OnColumnsIsNoWorseThanRays) {
  const std::string common = "--resolution 32 --fineness 24 --domain columns --json ";
  ASSERT_EQ(bench(common + file("run.json") + " --formulation rayrep").code, 0);
  const double rays = json().at("objective");
  ASSERT_EQ(bench(common + file("run.json") + " --formulation quadric").code, 0);
  EXPECT_EQ(json().at("domain"), "columns");
  EXPECT_LE(json().at("objective").get<double>(), rays + 1e-6);
}

TEST_F(QuadricRun, SaysWhatWouldHelp) {
  const BenchAnswer a = bench("--formulation quadric --resolution 24 --model spheres");
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_NE(a.out.find("a quadric separates the constraints from all fillings"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("would help "), std::string::npos) << a.out;
}

TEST_F(QuadricRun, RefusesADomainThatAFormulationCannotUse) {
  for (const auto& [arguments, said] :
       {std::pair{"--formulation rayrep --domain exact",
                  "domain 'exact' does not work with formulation 'rayrep'; it works with: quadric"},
        {"--domain octree", "domain = 'octree'; expected columns or exact"},
        {"--formulation quadric --solver ipopt",
         "solver 'ipopt' does not work with formulation 'quadric'"}}) {
    const BenchAnswer a = bench(arguments);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(said), std::string::npos) << a.out;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
