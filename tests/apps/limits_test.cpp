// limits_test.cpp - runs of an experiment that may take so much memory and time, as a user runs them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "apps/run_bench.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class LimitedRun : public ::testing::Test {
 protected:
  /// Writes the experiment and runs it. @param limits  lines of it
  BenchAnswer run(const std::string& limits, const std::string& more = "") const {
    (void)folder_.write("limited.toml", "resolution = 24\nfineness = 16\npart = \"none\"\n" + limits +
                                            "[[run]]\nset.solver.start = \"lower\"\n" + more);
    return bench("run limited.toml", fmt::format("cd '{}' &&", folder_.path.string()));
  }

  TemporaryFolder folder_;
};

TEST_F(LimitedRun, IsTheRunThatItWouldBeWithoutLimits) {
  const BenchAnswer limited = run("memory = 4\nseconds = 300\n");
  ASSERT_EQ(limited.code, 0) << limited.out;
  EXPECT_NE(limited.out.find("1 runs done, 0 finished before, 0 failed"), std::string::npos) << limited.out;
  // The same record: limits are no part of what a run is.
  const BenchAnswer free = run("");
  EXPECT_NE(free.out.find("0 runs done, 1 finished before, 0 failed"), std::string::npos) << free.out;
  EXPECT_NE(free.out.find("optimal"), std::string::npos) << free.out;
}

TEST_F(LimitedRun, ThatMeetsALimitIsAResultUntilTheLimitIsRaised) {
  const BenchAnswer late = run("seconds = 0.001\n");
  EXPECT_EQ(late.code, 4) << late.out;
  EXPECT_NE(late.out.find("failed: more than 0.001 s\n"), std::string::npos) << late.out;
  EXPECT_NE(late.out.find("error - more than 0.001 s\n"), std::string::npos) << "in the table: " << late.out;
  const BenchAnswer again = run("seconds = 0.001\n");
  EXPECT_NE(again.out.find("0 runs done, 1 finished before"), std::string::npos) << again.out;
  const BenchAnswer large = run("memory = 0.01\n");
  EXPECT_NE(large.out.find("failed: more than 0.01 GB\n"), std::string::npos) << large.out;
  const BenchAnswer raised = run("memory = 4\nseconds = 300\n");
  EXPECT_NE(raised.out.find("1 runs done"), std::string::npos) << raised.out;
}

TEST_F(LimitedRun, ThatIsRefusedSaysWhy) {
  const BenchAnswer a = run("seconds = 300\nset.ipopt.output_file = \"/nowhere/log\"\n");
  EXPECT_EQ(a.code, 4) << a.out;
  EXPECT_NE(a.out.find("ipopt.output_file = /nowhere/log cannot be written"), std::string::npos) << a.out;
}

TEST_F(LimitedRun, KeepsNoMeshAndNeedsLimitsAboveNothing) {
  const BenchAnswer mesh = run("seconds = 300\n", "part = \"written\"\nmesh = true\n");
  EXPECT_EQ(mesh.code, 2) << mesh.out;
  EXPECT_NE(mesh.out.find("expected a solve that keeps no mesh"), std::string::npos) << mesh.out;
  for (const char* limit : {"memory = 0\n", "seconds = -1\n"}) {
    const BenchAnswer a = run(limit);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find("limited.toml: line 4: "), std::string::npos) << a.out;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
