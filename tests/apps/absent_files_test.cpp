// absent_files_test.cpp - an experiment of meshes that not everyone has, as a user runs it.
#include <gtest/gtest.h>

#include "apps/run_bench.hpp"
#include "body/test_meshes.hpp"
#include "mesh/io/write.hpp"
#include "record/nest_record.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

class BenchAbsentFiles : public testing::Test {
 protected:
  BenchAbsentFiles() {
    folder_.write("t.toml",
                  "table = 'nestings'\n[[run]]\nouter = 'scans/cube.off'\ninner = 'scans/cube.off'");
    folder_.write("elsewhere/scans/note.txt", "a mesh was here");
  }
  [[nodiscard]] BenchAnswer run(const std::string& more = "") const {
    return bench("run t.toml " + more,
                 fmt::format("cd '{}' && unset KREISEL_MODELS;", folder_.path.string()));
  }
  [[nodiscard]] std::vector<std::filesystem::path> records() const {
    std::vector<std::filesystem::path> all;
    const auto runs = folder_.path / "results/runs/t";
    if (!std::filesystem::exists(runs)) return all;
    for (const auto& entry : std::filesystem::directory_iterator(runs)) all.push_back(entry.path());
    return all;
  }
  const TemporaryFolder folder_;
};

TEST_F(BenchAbsentFiles, SkipsTheRunAndEndsWell) {
  for (const std::string folder : {"", "--models elsewhere"}) {
    const BenchAnswer a = run(folder);
    EXPECT_EQ(a.code, 0) << a.out;
    const std::string where = folder.empty() ? "models" : "elsewhere";
    EXPECT_NE(
        a.out.find("cube in cube scale: skipped: no scans/cube.off in the current folder nor in " + where),
        std::string::npos)
        << a.out;
    EXPECT_NE(a.out.find("left out: 1 run, no scans/cube.off"), std::string::npos) << a.out;
    EXPECT_TRUE(records().empty());
  }
  const BenchAnswer dry = run("--dry-run");
  EXPECT_EQ(dry.code, 0) << dry.out;
  EXPECT_NE(dry.out.find("skipped, no mesh file"), std::string::npos) << dry.out;
}

TEST_F(BenchAbsentFiles, FindsTheFileInTheFolderThatIsNamedAndRecordsItsOwnName) {
  write_mesh(folder_.path / "elsewhere/scans/cube.off", {box_mesh({0, 0, 0}, {4, 4, 4})});
  const BenchAnswer a = run("--models elsewhere");
  ASSERT_EQ(a.code, 0) << a.out;
  ASSERT_EQ(records().size(), 1u) << a.out;
  EXPECT_EQ(read_nest(records().front()).config.outer, "scans/cube.off");
  // The same run from another folder, and from the current one.
  std::filesystem::rename(folder_.path / "elsewhere/scans", folder_.path / "scans");
  EXPECT_NE(run().out.find("0 runs done, 1 finished before"), std::string::npos);
}

TEST_F(BenchAbsentFiles, RefusesAFolderThatIsNone) {
  const BenchAnswer a = run("--models nowhere");
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find("--models nowhere: no such folder"), std::string::npos) << a.out;
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
