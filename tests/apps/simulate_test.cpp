// simulate_test.cpp - `bench simulate` as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/run_bench.hpp"
#include "installed.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using nlohmann::json;

class BenchSimulate : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }

  const TemporaryFolder folder_;
};

constexpr const char* quick = "--formulation quadric --resolution 24 --fineness 16";

TEST_F(BenchSimulate, ThePartSpinsWhereTheSolidDoesNotFromARecordAsFromItsMesh) {
  const BenchAnswer made = bench(fmt::format("{} --record {} --mesh {} --json {}", quick, file("run.h5"),
                                             file("part.stl"), file("run.json")));
  ASSERT_EQ(made.code, 0) << made.out;
  const BenchAnswer a = bench(fmt::format("simulate {} --seconds 2 --record {} --json {}", file("run.h5"),
                                          file("sim.h5"), file("s.json")));
  ASSERT_EQ(a.code, 0) << a.out;
  for (const char* part :
       {"gliding on a plane", "eq. 1", "were it balanced", "falls over", "stable", "drift"})
    EXPECT_NE(a.out.find(part), std::string::npos) << part << " in " << a.out;
  const json from_record = json::parse(std::ifstream(file("s.json")));
  EXPECT_FALSE(from_record.at("solid").at("spin").at("stable").get<bool>());
  EXPECT_FALSE(from_record.at("solid").at("spin").at("stays").get<bool>());
  const json& part = from_record.at("part").at("spin");
  EXPECT_TRUE(part.at("stable").get<bool>());
  EXPECT_TRUE(part.at("stays").get<bool>());
  EXPECT_LT(part.at("energy_drift").get<double>(), 1e-9);
  // Its two lateral moments differ, so all speeds are stable from eq. 1 on, and from there alone.
  EXPECT_NEAR(part.at("stable_rpm").at("gliding").back().at(0).get<double>(),
              from_record.at("part").at("values").at("omega_min_rpm").get<double>(), 0.1);

  const json contact = json::parse(std::ifstream(file("run.json"))).at("frame").at("contact");
  const BenchAnswer b =
      bench(fmt::format("simulate --mesh {} --contact {:.9f},{:.9f},{:.9f} --omega {} --seconds 2 --json - ",
                        file("part.stl"), contact.at(0).get<double>(), contact.at(1).get<double>(),
                        contact.at(2).get<double>(), from_record.at("rpm").get<double>()));
  ASSERT_EQ(b.code, 0) << b.out;
  const json from_mesh = json::parse(b.out);
  EXPECT_TRUE(from_mesh.at("hollow").get<bool>());
  EXPECT_NEAR(from_mesh.at("part").at("spin").at("largest_tilt_degrees").get<double>(),
              part.at("largest_tilt_degrees").get<double>(), 0.01);

  KREISEL_NEEDS(imports("h5py"), "h5py");
  const BenchAnswer h = shell(fmt::format("/usr/bin/python3 '{}/tests/record/simulation_h5py_test.py' {}",
                                          source_folder, file("sim.h5")));
  EXPECT_EQ(h.code, 0) << h.out;
}

TEST_F(BenchSimulate, ASolidHasOneColumnAndTheSameAnswerTwice) {
  const std::string command = "simulate --model teapot --contact held --omega 4000 --seconds 0.5 --json -";
  const BenchAnswer a = bench(command);
  ASSERT_EQ(a.code, 0) << a.out;
  const json all = json::parse(a.out);
  EXPECT_FALSE(all.at("hollow").get<bool>());
  EXPECT_EQ(all.at("contact"), "held");
  EXPECT_EQ(all.at("solid").at("spin"), all.at("part").at("spin"));
  json again = json::parse(bench(command).out), once = all;
  for (json* j : {&again, &once}) j->erase("provenance");  // which says when
  EXPECT_EQ(again, once);
}

TEST_F(BenchSimulate, WhatStandsAndFloatsDoesSoAsItsVerdictSays) {
  const auto simulated = [&](const char* run) {
    const BenchAnswer made = bench(fmt::format(
        "{} --formulation quadric --resolution 24 --fineness 12 --record {}", run, file("run.h5")));
    EXPECT_EQ(made.code, 0) << made.out;
    const BenchAnswer a = bench(
        fmt::format("simulate {} --record {} --json {}", file("run.h5"), file("sim.h5"), file("s.json")));
    EXPECT_EQ(a.code, 0) << a.out;
    EXPECT_NE(a.out.find("verdict"), std::string::npos) << a.out;
    return json::parse(std::ifstream(file("s.json"))).at("part");
  };
  const json stands = simulated("--problem stand --model kitten --target max-tilt");
  // Two of 360 directions are at most half a degree off the worst: its tangent is 4e-5 larger there.
  EXPECT_NEAR(stands.at("stand").at("topples_degrees").get<double>(),
              stands.at("values").at("tilt_degrees").get<double>(), 2e-3);

  const json floats = simulated("--problem float --model duck --draft 50%");
  const json& least = floats.at("float").at("least");
  const double height = floats.at("values").at("metacentric_height_mm").get<double>();
  // The draft is that of the part's own mass, which the verdict lets differ by a thousandth.
  EXPECT_NEAR(least.at("metacentric_height_mm").get<double>(), height, 0.02);
  EXPECT_LE(least.at("metacentric_height_mm").get<double>(),
            floats.at("float").at("across").at("metacentric_height_mm").get<double>());
  EXPECT_NEAR(least.at("heel_degrees").at(1).get<double>(), 5, 1e-12);
  EXPECT_NEAR(least.at("gz_mm").at(1).get<double>(), height * std::sin(5 * std::numbers::pi / 180), 0.05)
      << "small heels follow the metacentric height";
}

TEST_F(BenchSimulate, AYoyoSpinsAboutItsCentreOfMassByDefault) {
  const BenchAnswer a =
      bench(fmt::format("simulate --mesh cuboid --problem yoyo --seconds 0.2 --json {}", file("s.json")));
  ASSERT_EQ(a.code, 0) << a.out;
  const json solid = json::parse(std::ifstream(file("s.json"))).at("solid");
  EXPECT_TRUE(solid.at("ok").get<bool>()) << solid.at("text");
}

TEST_F(BenchSimulate, RefusesWhatItCannotDoInOneLine) {
  std::ofstream(file("not.h5")) << "no record";
  for (const std::string& bad :
       {std::string(), std::string("--mesh ellipsoid --omega -300"),
        std::string("--mesh ellipsoid --omega 0"), std::string("--mesh ellipsoid --tilt 0"),
        std::string("--mesh ellipsoid --seconds -1"), std::string("--mesh ellipsoid --contact sliding"),
        file("not.h5"), file("none.h5"), file("not.h5") + " --mesh ellipsoid",
        std::string("--mesh ellipsoid --problem balance --omega 500"),
        std::string("--mesh ellipsoid --problem spin --axle 3 --omega 500"),
        std::string("--mesh ellipsoid --record /no/such/folder/s.h5")}) {
    const BenchAnswer a = bench("simulate " + bad);
    EXPECT_EQ(a.code, 2) << bad << a.out;
    EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << bad << a.out;
    EXPECT_NE(a.out.find("expected"), std::string::npos) << a.out;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
