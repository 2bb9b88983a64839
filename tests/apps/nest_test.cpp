// nest_test.cpp - nesting as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "body/test_meshes.hpp"
#include "mesh/write.hpp"
#include "temporary_folder.hpp"

namespace kreisel {
namespace {

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

TEST_F(BenchNest, RefusesUnknownFreedomsAndVariantsInOneLine) {
  for (const auto& [arguments, says] :
       {std::pair{"--free rotatoin", "free part 'rotatoin' is unknown (did you mean 'rotation'?)"},
        std::pair{"--free all --swarm hybird", "variant 'hybird' is unknown (did you mean 'hybrid'?)"},
        std::pair{"--free all --particles 0", "particles = 0; expected at least one"}}) {
    const BenchAnswer a = nest(arguments);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(says), std::string::npos) << a.out;
  }
}

}  // namespace
}  // namespace kreisel
