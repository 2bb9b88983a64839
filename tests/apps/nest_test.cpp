// nest_test.cpp - nesting as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/run_bench.hpp"
#include "body/test_meshes.hpp"
#include "installed.hpp"
#include "mesh/io/write.hpp"
#include "nest/known_answers.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// A cube of 4 and one of 2 within it.
class BenchNest : public testing::Test {
 protected:
  BenchNest() {
    write_mesh(folder_.path / "large.off", {box_mesh({0, 0, 0}, {4, 4, 4})});
    write_mesh(folder_.path / "small.off", {box_mesh({0, 0, 0}, {2, 2, 2})});
  }
  [[nodiscard]] BenchAnswer nest(const std::string& more) const {
    return bench(
        fmt::format("nest --outer '{0}/large.off' --inner '{0}/small.off' {1}", folder_.path.string(), more));
  }
  const TemporaryFolder folder_;
};

TEST_F(BenchNest, SearchesTheScaleWhereItIsPutAndSaysWhatCannotBe) {
  const BenchAnswer a = nest("--json - --variant exact");
  EXPECT_EQ(a.code, 0) << a.out;
  const auto j = nlohmann::json::parse(a.out);
  EXPECT_NEAR(j.at("scale").get<double>(), 2, 1e-3) << "less its tolerance: touching is no nesting";
  EXPECT_EQ(nest("--scale 2.1").code, 3);
}

TEST_F(BenchNest, ASwarmFindsThePlaceAndIsTheSameForASeed) {
  const std::string swarm =
      "--free position,removal --centroid 1.5,1.5,1.5 --particles 20 --iterations 20 --json - ";
  const BenchAnswer a = nest(swarm);
  ASSERT_EQ(a.code, 0) << a.out;
  const auto j = nlohmann::json::parse(a.out);
  EXPECT_EQ(j.at("termination"), "valid");
  EXPECT_GT(j.at("scale").get<double>(), 1.8) << "1.5 where it was put; 2 in the middle";
  EXPECT_GE(j.at("certified_scale").get<double>(), j.at("scale").get<double>());
  EXPECT_EQ(j.at("trace").back().at(1), j.at("evaluations"));
  EXPECT_EQ(nlohmann::json::parse(nest(swarm).out).at("scale"), j.at("scale"));
}

TEST_F(BenchNest, WritesARecordThatH5pyReadsAndShowPrints) {
  const std::string record = (folder_.path / "nest.h5").string();
  const BenchAnswer a =
      nest("--free position,removal --particles 12 --iterations 8 --record '" + record + "'");
  ASSERT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("certified  valid on the triangles themselves at "), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("sampled    valid by 512 x 512 pixels up to "), std::string::npos) << a.out;
  const BenchAnswer shown = bench("show '" + record + "'");
  EXPECT_EQ(shown.code, 0) << shown.out;
  EXPECT_NE(shown.out.find("free=position,removal"), std::string::npos) << shown.out;
  KREISEL_NEEDS(shell("/usr/bin/python3 -c 'import h5py, numpy'").code == 0, "h5py");
  const BenchAnswer read =
      shell(fmt::format("/usr/bin/python3 '{}/tests/record/nest_h5py_test.py' '{}'", source_folder, record));
  EXPECT_EQ(read.code, 0) << read.out;
}

TEST_F(BenchNest, CtrlCKeepsTheBestAndACheckpointFromWhichItGoesOn) {
  const std::string kept = (folder_.path / "search.h5").string();
  const BenchAnswer stopped =
      bench(fmt::format(
                "nest --outer '{0}/large.off' --inner '{0}/small.off' --free all --particles 20 --iterations "
                "1000000 --checkpoint '{1}' --json '{0}/stopped.json'",
                folder_.path.string(), kept),
            "timeout --foreground --signal=INT 4");
  EXPECT_EQ(stopped.code, 124) << "as timeout says; " << stopped.out;
  ASSERT_TRUE(std::filesystem::exists(kept)) << stopped.out;
  std::ifstream file(folder_.path / "stopped.json");
  const auto j = nlohmann::json::parse(file);
  EXPECT_EQ(j.at("termination"), "interrupted");
  EXPECT_GT(j.at("scale").get<double>(), 0.5) << "of the first positions, if it came no further";
  const BenchAnswer resumed = bench("nest --resume '" + kept + "' --seconds 0.01 --json -");
  EXPECT_EQ(resumed.code, 0) << resumed.out;
  const auto more = nlohmann::json::parse(resumed.out);
  EXPECT_EQ(more.at("termination"), "out of time");
  EXPECT_GE(more.at("scale"), j.at("scale"));
  EXPECT_GE(more.at("evaluations"), j.at("evaluations"));
  const BenchAnswer refused = bench("nest --resume '" + kept + "' --particles 30");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.out.find("--particles with --resume; expected the options"), std::string::npos)
      << refused.out;
}

TEST_F(BenchNest, ASearchHeedsKeepOutsTopologyAndWhatIsFixed) {
  write_mesh(folder_.path / "ball.off", {nest::ball(8)});
  for (const int seed : {1, 2, 3}) {  // of all cuts through the centre four in ten part the cap
    const BenchAnswer a = bench(fmt::format(
        "nest --outer '{}/ball.off' --free plane,removal --keep-out 0,0,1,0.5 --particles 12 --iterations 8 "
        "--topology ring --momentum constriction --swarms 2 --climbs 2 --climb-iterations 5 --seed {} --json "
        "-",
        folder_.path.string(), seed));
    ASSERT_EQ(a.code, 0) << a.out;
    const auto j = nlohmann::json::parse(a.out);
    const auto vector = [](const nlohmann::json& v) { return Vec3(v.at(0), v.at(1), v.at(2)); };
    const Vec3 normal = vector(j.at("plane").at("normal")), point = vector(j.at("plane").at("point"));
    const double top = normal.dot(Vec3::UnitZ() - point);
    for (int k = 0; k < 12; ++k) {
      const double t = k * std::numbers::pi / 6;
      EXPECT_GT(top * normal.dot(Vec3(0.4 * std::cos(t), 0.4 * std::sin(t), std::sqrt(0.84)) - point), 0)
          << "the cap stays whole";
    }
    EXPECT_EQ(j.at("config").at("topology"), "ring");
    EXPECT_NEAR(j.at("transform").at(0).at(3).get<double>(), 0, 1e-12) << "the position is fixed";
  }
}

// The ball reaches the outer surface alone, not that of the space inside the wall.
TEST_F(BenchNest, TheOutermostCutOfLayersHeedsKeepOuts) {
  write_mesh(folder_.path / "ball.off", {nest::ball(8)});
  for (const int seed : {1, 2, 3, 4}) {
    const BenchAnswer a =
        bench(fmt::format("nest --outer '{}/ball.off' --layers 1 --wall 0.35 --cells 48 --free plane,removal "
                          "--keep-out 0,0,1,0.3 "
                          "1,0,0,0.3 --particles 12 --iterations 6 --climb-iterations 5 --seed {} --json -",
                          folder_.path.string(), seed));
    ASSERT_EQ(a.code, 0) << a.out;
    const auto j = nlohmann::json::parse(a.out);
    const auto vector = [](const nlohmann::json& v) { return Vec3(v.at(0), v.at(1), v.at(2)); };
    const Vec3 normal = vector(j.at("plane").at("normal")), point = vector(j.at("plane").at("point"));
    for (const Vec3& centre : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitX())}) {
      const Vec3 across = centre.cross(Vec3::UnitY());
      for (int k = 0; k < 12; ++k) {  // on the rim of a cap of radius 0.25
        const double t = k * std::numbers::pi / 6;
        const Vec3 rim = std::sqrt(1 - 0.0625) * centre +
                         0.25 * (std::cos(t) * across + std::sin(t) * Vec3(Vec3::UnitY()));
        EXPECT_GT(normal.dot(centre - point) * normal.dot(rim - point), 0) << "the cap stays whole";
      }
    }
  }
  const BenchAnswer far = bench(fmt::format(
      "nest --outer '{}/ball.off' --layers 1 --free all --keep-out 9,9,9,0.1", folder_.path.string()));
  EXPECT_EQ(far.code, 2) << far.out;
  EXPECT_NE(far.out.find("no vertex of the outer shape lies in it"), std::string::npos) << far.out;
}

TEST_F(BenchNest, RefusesWhatAKindOfNestingWouldIgnore) {
  const std::string no = " has no such field; expected a kind that has it: ";
  for (const auto& [arguments, says] :
       {std::pair{"--layers 2 --free all --timings 3", "timings: a nesting of layers" + no},
        std::pair{"--layers 2 --free all --centroid 0,0,0", "centroid: a nesting of layers" + no},
        std::pair{"--layers 2 --free all --through 0,0,0", "through: a nesting of layers" + no},
        std::pair{"--particles 30", "particles: a search of the scale" + no + "swarm, layers"},
        std::pair{"--seconds 3", "seconds: a search of the scale" + no + "swarm, layers"},
        std::pair{"--keep-out 0,0,1,1", "keep-out: a search of the scale" + no + "swarm, layers"},
        std::pair{"--layers 2 --free all --checkpoint /tmp/x.h5",
                  std::string("--checkpoint of a nesting of layers")}}) {
    const BenchAnswer a = nest(arguments);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(says), std::string::npos) << a.out;
  }
}

TEST_F(BenchNest, LooksForEveryShapeBeforeItWorks) {
  const BenchAnswer a = nest("--layers 2 --free all --within nosuchmodel");
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find("nosuchmodel"), std::string::npos) << a.out;
}

TEST_F(BenchNest, RefusesUnknownFreedomsAndVariantsInOneLine) {
  for (const auto& [arguments, says] :
       {std::pair{"--free rotatoin", "free part 'rotatoin' is unknown (did you mean 'rotation'?)"},
        std::pair{"--free all --swarm hybird", "variant 'hybird' is unknown (did you mean 'hybrid'?)"},
        std::pair{"--free all --particles 0", "particles = 0; expected at least one"},
        std::pair{"--free all --swarm pagmo-de", "the program nest_baseline"},
        std::pair{"--checkpoint /tmp/x.h5", "--checkpoint of a search of the scale; expected"},
        std::pair{"--free all --keep-out 1,2,3", "keep-out = '1,2,3'; expected a ball"},
        std::pair{"--free all --keep-out 9,9,9,0.1", "no vertex of the outer shape lies in it"},
        std::pair{"--resume nowhere.h5", "nowhere.h5: cannot be opened"},
        std::pair{"--timings -1", "timings = '-1'; expected"}}) {
    const BenchAnswer a = nest(arguments);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(says), std::string::npos) << a.out;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
