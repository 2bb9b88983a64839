// bench_test.cpp - `bench` as a user runs it: exit codes, messages, files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "body/hydrostatics.hpp"
#include "body/mesh_moments.hpp"
#include "installed.hpp"
#include "mesh/io/read.hpp"
#include "mesh/io/write.hpp"
#include "mesh/shapes.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

class Bench : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }

  const TemporaryFolder folder_;
};

constexpr const char* small = "--formulation rayrep --resolution 24 --fineness 16";

TEST_F(Bench, RunsWithDefaultsAndSaysWhetherThePartSpins) {
  const BenchAnswer a = bench("--formulation rayrep");
  EXPECT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("optimal"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("verified   spins:"), std::string::npos) << a.out;
}

TEST_F(Bench, WritesAMeshWhoseMomentsAreTheReportedOnes) {
  const BenchAnswer a = bench(fmt::format("{} --set formulation.bounds=ordered --json {} --mesh {}", small,
                                          file("r.json"), file("part.stl")));
  ASSERT_EQ(a.code, 0) << a.out;
  const auto json = nlohmann::json::parse(std::ifstream(file("r.json")));
  EXPECT_EQ(json.at("formulation"), "rayrep");
  EXPECT_EQ(json.at("termination"), "optimal");
  EXPECT_EQ(json.at("moments").size(), 10u);
  EXPECT_LE(json.at("constraint_violation").get<double>(), 1e-8);
  // The file holds floats of up to 60 mm: 4e-6 mm a coordinate, at random. A moment is at most s1 60^2.
  const Moments written = 1e-3 * reference::mesh_moments(read_mesh(file("part.stl"))).value;  // 1 g/cm^3
  const double reach[] = {1, 60, 60, 60, 3600, 3600, 3600, 3600, 3600, 3600};
  for (int k = 0; k < 10; ++k)
    EXPECT_NEAR(written[k], json.at("moments")[k].get<double>(), 1e-6 * reach[k] * written[S1])
        << "moment " << k;
}

TEST_F(Bench, WritesARecordThatH5pyReadsByTheSchema) {
  KREISEL_NEEDS(imports("h5py"), "h5py");
  const BenchAnswer a = bench(fmt::format("{} --record {}", small, file("run.h5")));
  ASSERT_NE(a.code, 2) << a.out;
  EXPECT_EQ(std::system(fmt::format("/usr/bin/python3 '{}/tests/record/h5py_test.py' {}", source_folder,
                                    file("run.h5"))
                            .c_str()),
            0);
}

TEST_F(Bench, JsonToStandardOutputIsAlone) {
  const BenchAnswer a = bench(fmt::format("{} --json -", small));
  ASSERT_EQ(a.code, 0);
  EXPECT_TRUE(nlohmann::json::accept(a.out)) << a.out;
}

TEST_F(Bench, VoxelAndRayRepAgreeWithinOnePercent) {
  double objective[2];
  for (const int i : {0, 1}) {
    const BenchAnswer a = bench(fmt::format("{} --formulation {} --json {}", "--resolution 32",
                                            i ? "voxel" : "rayrep", file("r.json")));
    ASSERT_EQ(a.code, 0) << a.out;
    objective[i] = nlohmann::json::parse(std::ifstream(file("r.json"))).at("objective").get<double>();
  }
  EXPECT_NEAR(objective[0], objective[1], 0.01 * objective[1]);
}

/// The bird on a coarse grid: its wall is thick, and what can be asked of it is little.
constexpr const char* bird = "--model bird --fineness 16 --resolution 24";

nlohmann::json json_of(const std::string& file) { return nlohmann::json::parse(std::ifstream(file)); }

/// Moments of a written file, g and mm; at 1 g/cm^3.
Moments written_moments(const std::string& file) {
  return 1e-3 * reference::mesh_moments(read_mesh(file)).value;
}

TEST_F(Bench, AFloatIsWrittenWithTheMassOfTheWaterThatItsOutsideDisplaces) {
  const BenchAnswer a = bench(fmt::format("{} --problem float --set problem.draft=60% --json {} --mesh {}",
                                          bird, file("r.json"), file("part.stl")));
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("  possible   at this draft with a material of"), std::string::npos) << a.out;
  EXPECT_EQ(a.out.find("  infeasible "), std::string::npos) << a.out;
  const auto json = json_of(file("r.json"));
  EXPECT_EQ(json.at("problem"), "float");
  EXPECT_EQ(json.at("termination"), "optimal");
  EXPECT_EQ(json.at("steps"), 1);
  EXPECT_EQ(json.at("infeasibility"), "");
  EXPECT_NE(json.at("scope").get<std::string>().find("(here 1)"), std::string::npos) << json.at("scope");
  EXPECT_EQ(json.at("variables"), json.at("rays")) << "one a ray";

  // What the program says of the file, from the file: its outer shell is its largest part, and comes first.
  const TriangleMesh part = read_mesh(file("part.stl"));
  const auto& verified = json.at("verified");
  TriangleMesh outer = part;
  outer.triangles.resize(verified.at("triangles").get<std::size_t>() -
                         verified.at("void_triangles").get<std::size_t>());
  const Box box = bounding_box(outer);
  const Hydrostatics water = hydrostatics(outer, box.lo[2] + 0.6 * box.extent()[2]);
  const Moments s = written_moments(file("part.stl"));
  const Eigen::Vector3d c = centre_of_mass(s);
  // Coordinates are written as floats of up to 60 mm, 2e-6 mm off; over an area of some 10^4 mm^2.
  EXPECT_NEAR(verified.at("displaced_mm3").get<double>(), water.volume, 0.1);
  EXPECT_NEAR(verified.at("excess_mass").get<double>(), s[S1] / (1e-3 * water.volume) - 1, 1e-5);
  EXPECT_NEAR(verified.at("metacentric_height_mm").get<double>(), water.metacentre() - c[2], 1e-4);
  EXPECT_NEAR(verified.at("offset_mm").get<double>(), (c - water.centre_of_buoyancy).head<2>().norm(), 1e-4);
  // The optimum has the mass to 1e-9; rounded, each ray is off by half a voxel at most, at random.
  EXPECT_NEAR(s[S1], 1e-3 * water.volume, 0.01 * s[S1]);
}

TEST_F(Bench, AFloatThatIsTooHeavyEndsWithThreeAndSaysWhatIsOutOfReach) {
  const BenchAnswer a = bench(fmt::format("{} --problem float --density 3 --json {} --record {}", bird,
                                          file("r.json"), file("r.h5")));
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_NE(a.out.find("  infeasible the mass stays "), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("does not float upright (too heavy"), std::string::npos) << a.out;
  const auto json = json_of(file("r.json"));
  EXPECT_EQ(json.at("termination"), "infeasible");
  // All void, the shell alone is left: what it weighs beyond the water, in grams.
  double miss = 0;
  const std::string text = json.at("infeasibility");
  ASSERT_EQ(std::sscanf(text.c_str(), "the mass stays %lf g away from that of the displaced water", &miss), 1)
      << text;
  EXPECT_NE(text.find(" g"), std::string::npos) << text;
  const double shell = json.at("moments")[0].get<double>();
  const double water = json.at("verified").at("displaced_mm3").get<double>() * 1e-3;
  const double rounding = 1e-6 * json.at("solid_mass_g").get<double>();
  EXPECT_NEAR(miss, shell - water, 6e-3 * miss + rounding) << "three digits are printed";
  const std::string shown = bench("show " + file("r.h5")).out;
  EXPECT_NE(shown.find("  infeasible " + text + "\n"), std::string::npos) << shown;
  EXPECT_NE(shown.find("  possible   " + json.at("scope").get<std::string>() + "\n"), std::string::npos)
      << shown;
}

TEST_F(Bench, TheSteepestTiltIsASequenceOfSolves) {
  const BenchAnswer a = bench(fmt::format(
      "{} --problem stand --set problem.target=max-tilt --set problem.base=0.1% --json {} --mesh {}", bird,
      file("r.json"), file("part.stl")));
  ASSERT_EQ(a.code, 0) << a.out;
  const auto json = json_of(file("r.json"));
  EXPECT_GT(json.at("steps"), 1);
  EXPECT_LE(json.at("steps"), 8) << "superlinear";
  EXPECT_NE(a.out.find(fmt::format(", {} steps)", json.at("steps").get<int>())), std::string::npos) << a.out;
  EXPECT_LT(json.at("objective"), json.at("solid_objective")) << "steeper than the solid";
  const double tilt = json.at("verified").at("tilt_degrees");
  const double tangent = std::tan(tilt * std::acos(-1.0) / 180);
  EXPECT_NEAR(tangent, -json.at("rounding").at("objective").get<double>(), 1e-6) << "round-off of the file";
  const Eigen::Vector3d c = centre_of_mass(written_moments(file("part.stl")));
  const double base = bounding_box(read_mesh(file("part.stl"))).lo[2];
  EXPECT_NEAR(json.at("verified").at("centre_of_mass_z_mm").get<double>(), c[2] - base, 1e-4);
}

TEST_F(Bench, BalancesAtAPointOfTheModelsOwnCoordinates) {
  const BenchAnswer solid =
      bench(fmt::format("{} --problem stand --set problem.target=inside --set problem.base=0.1% --json {}",
                        bird, file("solid.json")));
  ASSERT_NE(solid.code, 2) << solid.out;
  const auto m = json_of(file("solid.json")).at("moments");
  // Near to a centre of mass that can be had, so there is a way.
  const double x = m[1].get<double>() / m[0].get<double>(), y = m[2].get<double>() / m[0].get<double>(),
               z = m[3].get<double>() / m[0].get<double>() + 0.3;
  const BenchAnswer a =
      bench(fmt::format("{} --problem balance --set problem.point={:.3f},{:.3f},{:.3f} --json {} "
                        "--mesh {}",
                        bird, x, y, z, file("r.json"), file("part.stl")));
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_EQ(json_of(file("r.json")).at("termination"), "optimal");
  const Eigen::Vector3d c = centre_of_mass(written_moments(file("part.stl")));
  EXPECT_NEAR((c - Vec3(x, y, z)).norm(),
              json_of(file("r.json")).at("verified").at("offset_mm").get<double>(), 1e-3);
  // Rounded to voxels of 2.5 mm, half of one a ray at random.
  EXPECT_NEAR((c - Vec3(x, y, z)).norm(), 0, 0.1);
}

TEST_F(Bench, EverySettingOfAProblemCanBeGivenToEveryFormulation) {
  for (const char* way : {"--formulation voxel", "--formulation rayrep --set formulation.unit=body",
                          "--formulation rayrep --set ipopt.hessian_approximation=limited-memory"})
    for (const char* problem :
         {"float --set problem.fluid_density=1.2 --set problem.draft=25mm",
          "stand --set problem.target=inside --set problem.margin=0.1 --set problem.base=2%"}) {
      const BenchAnswer a = bench(fmt::format("{} {} --problem {}", bird, way, problem));
      EXPECT_EQ(a.code, 0) << way << ' ' << problem << '\n' << a.out;
      EXPECT_NE(a.out.find("  solve      optimal"), std::string::npos) << a.out;
    }
}

TEST_F(Bench, PartsThatTouchAlongAnEdgeAreVerifiedInEveryFormat) {
  const std::string model = file("touching.off");
  write_mesh(model, {both(box_mesh({0, 0, 0}, {4, 4, 4}), box_mesh({4, 4, 0}, {8, 8, 4}))});
  for (const char* part : {"part.stl", "part.3mf", "part.ply"}) {
    const BenchAnswer a = bench(
        fmt::format("--model {} --resolution 24 --json {} --mesh {}", model, file("r.json"), file(part)));
    ASSERT_EQ(a.code, 0) << a.out;
    EXPECT_NE(a.out.find("  verified   spins"), std::string::npos) << part << '\n' << a.out;
    // Eighths and thirds of a millimetre as floats of up to 8 mm: 5e-7 of 8, at random, in numbers of order
    // one.
    EXPECT_LE(json_of(file("r.json")).at("verified").at("rounding_mismatch").get<double>(), 1e-6) << part;
    EXPECT_EQ(bench("inspect " + file(part)).code, 0) << part;
  }
}

TEST_F(Bench, RunsAnExperimentSkipsWhatIsDoneAndShowsIt) {
  std::ofstream(file("tiny.toml"))
      << "problem = \"spin\"\nmodel = \"ellipsoid\"\nresolution = 32\nfineness = 16\n"
         "[[run]]\nformulation = [\"rayrep\", \"voxel\"]\n";
  const std::string run = fmt::format("run {} --results {}", file("tiny.toml"), file("runs"));
  EXPECT_NE(bench(run + " --dry-run").out.find("2 to run"), std::string::npos);
  const BenchAnswer first = bench(run);
  EXPECT_EQ(first.code, 0) << first.out;
  EXPECT_NE(first.out.find("2 runs done, 0 finished before"), std::string::npos) << first.out;
  const BenchAnswer second = bench(run);
  EXPECT_NE(second.out.find("0 runs done, 2 finished before"), std::string::npos) << second.out;
  const BenchAnswer shown = bench(fmt::format("show {}", file("runs")));
  EXPECT_EQ(shown.code, 0) << shown.out;
  EXPECT_NE(shown.out.find("verified"), std::string::npos) << shown.out;
}

TEST_F(Bench, ListNamesEverythingAndWhichPairsWork) {
  const BenchAnswer a = bench("list");
  EXPECT_EQ(a.code, 0);
  for (const char* name : {"ellipsoid", "bird", "spin", "stand", "float", "balance", "voxel", "rayrep",
                           "ipopt", "rayrep_table2"})
    EXPECT_NE(a.out.find(name), std::string::npos) << name;
}

TEST_F(Bench, DevicesSaysWhatThereIs) {
  const BenchAnswer a = bench("devices --no-measure");
  EXPECT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("fp64"), std::string::npos);
}

TEST_F(Bench, EndsWithTheSolveWhenNoPartIsAskedFor) {
  const BenchAnswer a = bench(
      "--model ellipsoid --fineness 16 --resolution 24 --formulation quadric --part none --json - --record " +
      file("n.h5"));
  ASSERT_EQ(a.code, 0) << a.out;
  const auto json = nlohmann::json::parse(a.out);
  EXPECT_EQ(json.at("termination"), "optimal");
  EXPECT_TRUE(json.at("verified").is_null());
  EXPECT_NE(bench("show " + file("n.h5")).out.find("none made"), std::string::npos);
  const BenchAnswer both =
      bench("--model ellipsoid --fineness 16 --resolution 24 --part none --mesh " + file("n.stl"));
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.out.find("expected no mesh"), std::string::npos) << both.out;
  EXPECT_FALSE(std::filesystem::exists(file("n.stl")));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
