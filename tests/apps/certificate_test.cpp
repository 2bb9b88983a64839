// certificate_test.cpp - certified runs as a user makes them, and their check by a program of its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/run_bench.hpp"
#include "installed.hpp"
#include "places.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

const std::string python = "/usr/bin/python3";

class Certified : public testing::Test {
 protected:
  [[nodiscard]] std::string record() const { return (folder_.path / "run.h5").string(); }
  [[nodiscard]] nlohmann::json run(const std::string& arguments, int code = 0) const {
    const BenchAnswer answer = bench(fmt::format("--record '{}' --json '{}' {}", record(),
                                                 (folder_.path / "run.json").string(), arguments));
    EXPECT_EQ(answer.code, code) << answer.out;
    said_ = answer.out;
    std::ifstream in(folder_.path / "run.json");
    return nlohmann::json::parse(in, nullptr, false);
  }
  [[nodiscard]] BenchAnswer check() const {
    return shell(fmt::format("{} '{}/plots/check_certificate.py' '{}'", python, source_folder, record()));
  }
  static bool can_check() { return imports("h5py, numpy"); }

  TemporaryFolder folder_;
  mutable std::string said_;
};

TEST_F(Certified, EveryKindHoldsInAnotherProgram) {
  KREISEL_NEEDS(can_check(), "h5py");
  const std::string quadric = "--formulation quadric --solver moment --certify ";
  for (const auto& [arguments, code, kind] :
       {std::tuple{"--model ellipsoid --resolution 40", 0, "spin"},
        std::tuple{"--model bird --resolution 40 --set problem.lambda=1", 0, "spin"},
        std::tuple{"--model ellipsoid --resolution 40 --void-density 0.1", 0, "spin"},
        std::tuple{"--model ellipsoid --resolution 40 --problem top --lower height", 0, "spin"},
        std::tuple{"--model ellipsoid --resolution 40 --problem top", 0, "top"},
        std::tuple{"--model cuboid --resolution 24 --problem yoyo --axis 0.1,0,1", 0, "yoyo"},
        std::tuple{"--model kitten --resolution 24 --problem float --draft 80%", 0, "linear"},
        std::tuple{"--model kitten --resolution 24 --problem stand --target inside", 0, "ratio"},
        std::tuple{"--model kitten --resolution 24 --problem stand --target max-tilt", 0, "ratio"},
        std::tuple{"--model kitten --resolution 24 --problem stand", 3, "infeasible"}}) {
    const nlohmann::json j = run(quadric + arguments, code);
    EXPECT_EQ(j.at("certificate"), kind) << arguments;
    if (code == 0) {
      EXPECT_LE(j.at("gap").get<double>(), 1e-3) << arguments;
    }
    const BenchAnswer answer = check();
    EXPECT_EQ(answer.code, 0) << arguments << ": " << answer.out;
    EXPECT_NE(answer.out.find("proved"), std::string::npos) << answer.out;
  }
}

TEST_F(Certified, WhateverTheFormulation) {
  for (const char* way : {"rayrep", "voxel"}) {
    const nlohmann::json j =
        run(fmt::format("--model ellipsoid --resolution 40 --formulation {} --certify", way));
    const double f = j.at("objective").get<double>(), bound = j.at("bound").get<double>();
    EXPECT_LE(bound, f + 1e-7);
    EXPECT_NEAR(j.at("gap").get<double>(), (f - bound) / f, 1e-12);
    EXPECT_LT(j.at("gap").get<double>(), 0.02);
    EXPECT_GE(j.at("boxes").get<int>(), 3);
    EXPECT_GT(j.at("certify_seconds").get<double>(), 0);
    EXPECT_NE(said_.find("certified  f >= "), std::string::npos) << said_;
    if (can_check()) {
      EXPECT_EQ(check().code, 0) << check().out;
    }
  }
}

/// Each in a fresh copy: what proves nothing must not pass.
TEST_F(Certified, WhatWasTamperedWithFails) {
  KREISEL_NEEDS(can_check(), "h5py");
  (void)run("--model ellipsoid --resolution 40 --formulation quadric --solver moment --certify");
  std::filesystem::copy_file(record(), folder_.path / "clean.h5");
  ASSERT_EQ(check().code, 0);
  for (const char* edit : {
           "c.attrs['bound'] += 1e-6; f.attrs['bound'] += 1e-6",
           "f.attrs['gap'] /= 2",
           "c['boxes'][n, 3] += 1e-6; c.attrs['bound'] += 0",
           "c['boxes'][n, 4] += 1e-4; c['box_quadrics'][2 * n, 7:9] -= 1e-4",
           "c['boxes'][n, 0] += 1e-9",
           "c['boxes'][n, 6:8] *= 2",
           "c['boxes'][n, 9] += 0.01",
           "c['boxes'][n, 13] += 0.01",
           "c['boxes'][0, 1] += 0.05; c['boxes'][1, 0] += 0.05",
           "c.attrs['contrast'] *= 1.01",
           "c.attrs['gamma_i'] *= 1.01",
           "f['body/fixed'][7] *= 0.9",
           "f['domain/intervals'][0:20, 3] += 3",
           "f['solve/moments'][7] *= 1.01",
           "b = c['boxes'][:]; a = dict(c['boxes'].attrs); del c['boxes']; "
           "d = c.create_dataset('boxes', data=np.delete(b, n, axis=0)); d.attrs.update(a)",
       }) {
    std::filesystem::copy_file(folder_.path / "clean.h5", record(),
                               std::filesystem::copy_options::overwrite_existing);
    // n: the box that decides.
    const BenchAnswer edited = shell(
        fmt::format("{} -c \"import h5py, numpy as np; f = h5py.File('{}', 'r+'); c = f['certificate']; "
                    "n = int(np.argmin(c['boxes'][:, 3])); {}; f.close()\"",
                    python, record(), edit));
    ASSERT_EQ(edited.code, 0) << edit << '\n' << edited.out;
    const BenchAnswer answer = check();
    EXPECT_EQ(answer.code, 1) << edit << '\n' << answer.out;
  }
}

/// What a top has beside: boxes of two sides, which have to cover all of them.
TEST_F(Certified, ATopThatWasTamperedWithFails) {
  KREISEL_NEEDS(can_check(), "h5py");
  (void)run("--model ellipsoid --resolution 40 --formulation quadric --problem top --certify");
  std::filesystem::copy_file(record(), folder_.path / "clean.h5");
  ASSERT_EQ(check().code, 0) << check().out;
  for (const char* edit : {
           "c.attrs['bound'] += 1e-6; f.attrs['bound'] += 1e-6",
           "c.attrs['moment'] *= 0.99",
           "c.attrs['sz_most'] *= 1.01",
           "c['boxes'][n, 3] += 1e-6",
           "c['boxes'][n, 14] += 1e-9",
           "c['boxes'][n, 16] += 1e-3; c['box_quadrics'][4 * n + 2, 7:9] -= 1e-3",
           "c['boxes'][n, 18] += 0.01",
           "c['boxes'][n, 2] = 1; c['boxes'][n, 3] = np.inf",
       }) {
    std::filesystem::copy_file(folder_.path / "clean.h5", record(),
                               std::filesystem::copy_options::overwrite_existing);
    const BenchAnswer edited = shell(
        fmt::format("{} -c \"import h5py, numpy as np; f = h5py.File('{}', 'r+'); c = f['certificate']; "
                    "n = int(np.argmin(c['boxes'][:, 3])); {}; f.close()\"",
                    python, record(), edit));
    ASSERT_EQ(edited.code, 0) << edit << '\n' << edited.out;
    EXPECT_EQ(check().code, 1) << edit;
  }
}

TEST_F(Certified, ARandomStartIsAnOption) {
  const std::string common = "--model ellipsoid --resolution 40 --formulation quadric --solver moment ";
  const double f = run(common).at("objective").get<double>();
  EXPECT_NEAR(run(common + "--set moment.seed=7").at("objective").get<double>(), f, 1e-9);
  EXPECT_EQ(bench(common + "--set moment.seed=-1").code, 2);
}

TEST_F(Certified, AGapThatIsNoneIsRefused) {
  for (const char* text : {"0", "2", "-1", "none"}) {
    const BenchAnswer answer = bench(fmt::format("--certify={}", text));
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.out.find("certify"), std::string::npos) << answer.out;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
