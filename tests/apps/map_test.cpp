// map_test.cpp - `bench map` as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "installed.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class BenchMap : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }

  /// Runs tests/record/map_h5py_test.py on a map.
  void expect_h5py_reads(const std::string& map) const {
    KREISEL_NEEDS(imports("h5py"), "h5py");
    const BenchAnswer a =
        shell(fmt::format("/usr/bin/python3 '{}/tests/record/map_h5py_test.py' {}", source_folder, map));
    EXPECT_EQ(a.code, 0) << a.out;
  }

  const TemporaryFolder folder_;
};

constexpr const char* small = "ellipsoid --resolution 24 --fineness 16";

TEST_F(BenchMap, WritesARecordThatH5pyReadsAndSaysHowToMakeTheBest) {
  const BenchAnswer a =
      bench(fmt::format("map {} --axes 60 --record {} --json {}", small, file("map.h5"), file("map.json")));
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("of spin"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("feasible"), std::string::npos) << a.out;
  expect_h5py_reads(file("map.h5"));

  const auto json = nlohmann::json::parse(std::ifstream(file("map.json")));
  ASSERT_EQ(json.at("axes").size(), 60u);
  EXPECT_EQ(json.at("termination"), "complete");
  const auto& cases = json.at("cases").at(0);
  EXPECT_EQ(
      cases.at("feasible").get<int>() + cases.at("infeasible").get<int>() + cases.at("undecided").get<int>(),
      60);
  EXPECT_GT(cases.at("feasible").get<int>(), 0);
  EXPECT_GT(cases.at("infeasible").get<int>(), 0);

  const std::string command = json.at("best").at("command");
  ASSERT_TRUE(command.starts_with("bench ")) << command;
  const BenchAnswer made = bench(command.substr(6) + " --json " + file("best.json"));
  ASSERT_EQ(made.code, 0) << made.out;
  const auto best = nlohmann::json::parse(std::ifstream(file("best.json")));
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(best.at("frame").at("axis")[k].get<double>(), json.at("best").at("axis")[k].get<double>(),
                1e-8);
    EXPECT_NEAR(best.at("frame").at("contact")[k].get<double>(),
                json.at("best").at("contact")[k].get<double>(), 1e-6);
  }
  // Another grid, whose cells take in a tenth more or less of the interior: see orientation_map_test.cpp.
  EXPECT_NEAR(best.at("objective").get<double>(), json.at("best").at("objective").get<double>(),
              0.1 * best.at("objective").get<double>());
}

TEST_F(BenchMap, FloatsAtSeveralDrafts) {
  const BenchAnswer a = bench(fmt::format(
      "map {} --problem float --drafts 40%,70% --axes 12 --record {} --json -", small, file("m.h5")));
  ASSERT_EQ(a.code, 0) << a.out;
  const auto json = nlohmann::json::parse(a.out);
  ASSERT_EQ(json.at("cases").size(), 2u);
  EXPECT_EQ(json.at("cases")[1].at("draft"), "70%");
  EXPECT_EQ(json.at("axes")[0].at("answers").size(), 2u);
  EXPECT_NE(json.at("best").at("command").get<std::string>().find("--up="), std::string::npos);
  expect_h5py_reads(file("m.h5"));
}

TEST_F(BenchMap, KeepsWhatIsDoneWhenInterrupted) {
  const BenchAnswer a =
      shell(fmt::format("timeout --preserve-status -s INT 6 '{}' map {} --axes 2000000 --record {}",
                        bench_program, small, file("part.h5")));
  EXPECT_EQ(a.code, 130) << a.out;
  if (!std::filesystem::exists(file("part.h5")) && a.out.find("domain") == std::string::npos)
    GTEST_SKIP() << "too slow to get beyond the set-up within 6 s";
  EXPECT_NE(a.out.find("of 2000000, interrupted"), std::string::npos) << a.out;
  expect_h5py_reads(file("part.h5"));
}

TEST_F(BenchMap, AreAnExperimentWithATableAndAPictureEach) {
  std::ofstream(file("maps.toml"))
      << "table = 'maps'\nfigures = ['map']\nmodel = 'ellipsoid'\nresolution = 24\n"
         "fineness = 16\naxes = 30\n[[run]]\nthrough = 'centre'\n"
         "[[run]]\nproblem = 'float'\ndrafts = '40%,70%'\n";
  const std::string run = fmt::format("run {} --results {}", file("maps.toml"), file("runs"));
  BenchAnswer a = bench(run);
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("2 runs done, 0 finished before, 0 failed"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("70%"), std::string::npos) << a.out;
  a = bench(run);
  EXPECT_NE(a.out.find("0 runs done, 2 finished before, 0 failed"), std::string::npos) << a.out;
  a = bench("show " + file("runs"));
  EXPECT_EQ(a.code, 0);
  EXPECT_NE(a.out.find("make it    bench --"), std::string::npos) << a.out;
  KREISEL_NEEDS(imports("h5py, matplotlib"), "h5py or matplotlib");
  a = bench(fmt::format("report {} --results {} -o {}", file("maps.toml"), file("runs"), file("page.html")));
  ASSERT_EQ(a.code, 0) << a.out;
  std::ifstream stream(file("page.html"));
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  std::size_t images = 0;
  for (std::size_t at = page.find("<img"); at != std::string::npos; at = page.find("<img", at + 1)) ++images;
  EXPECT_EQ(images, 2u);
  EXPECT_EQ(page.find("class=\"missing\""), std::string::npos);
}

TEST_F(BenchMap, RefusesWhatItCannotDoInOneLine) {
  for (const char* bad : {"--problem stand", "--axes 0", "--drafts 40%", "--problem float --drafts 140%",
                          "--formulation voxel", "--record /no/such/folder/m.h5"}) {
    const BenchAnswer a = bench(fmt::format("map {} {}", small, bad));
    EXPECT_EQ(a.code, 2) << bad << a.out;
    EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
    EXPECT_NE(a.out.find("expected"), std::string::npos) << a.out;
  }
  EXPECT_EQ(bench("map").code, 2);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
