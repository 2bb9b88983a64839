// endings_test.cpp - `bench` where it cannot go on: no device, no memory, a full disk, Ctrl-C.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "apps/run_bench.hpp"
#include "record/records_in.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

constexpr const char* tiny = "--resolution 24 --fineness 16";

class Endings : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path / name).string(); }

  /// Names of all files, folders aside, in order.
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path))
      if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  const TemporaryFolder folder_;
};

void expect_one_line(const BenchAnswer& a, int code, const std::string& says) {
  EXPECT_EQ(a.code, code) << a.out;
  EXPECT_EQ(std::ranges::count(a.out, '\n'), 1) << a.out;
  EXPECT_EQ(a.out.find("bench: "), 0u) << a.out;
  EXPECT_NE(a.out.find(says), std::string::npos) << a.out;
}

TEST_F(Endings, WithoutAnOpenClDeviceSaysWhatToInstall) {
  fs::create_directories(folder_.path / "none");
  for (const char* command : {"", "devices"}) {
    const BenchAnswer a = bench(fmt::format("{} {}", command, *command ? "" : tiny),
                                fmt::format("OCL_ICD_VENDORS='{}/'", file("none")));
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find("bench: no OpenCL device found; expected at least PoCL"), std::string::npos)
        << a.out;
  }
  const BenchAnswer inspected =
      bench("inspect ellipsoid --json -", fmt::format("OCL_ICD_VENDORS='{}/'", file("none")));
  EXPECT_EQ(inspected.code, 0) << "which needs none: " << inspected.out;
}

TEST_F(Endings, AFolderThatPoclCannotWriteIsNamed) {
  std::ofstream(file("taken")) << "a file";
  for (const std::string& folder : {file("taken"), file("taken") + "/below"}) {
    const std::string elsewhere =
        fmt::format("POCL_CACHE_DIR='{}' KREISEL_CACHE_DIR='{}'", folder, file("own"));
    const BenchAnswer a = bench(tiny, elsewhere);
    EXPECT_EQ(a.code, 2) << a.out;
    EXPECT_NE(a.out.find(folder + " by POCL_CACHE_DIR"), std::string::npos) << a.out;
    EXPECT_EQ(a.out.find("internal error"), std::string::npos) << a.out;
  }
}

TEST_F(Endings, AnEmptyNameOfPoclsFolderIsAsNone) {
  const BenchAnswer a = bench(tiny, "POCL_CACHE_DIR=''");
  EXPECT_EQ(a.code, 0) << a.out;
}

TEST_F(Endings, AFolderOfPoclWithoutRoomIsNamed) {
  // A file system of its own, for who may mount one.
  const BenchAnswer a = bench(
      tiny, fmt::format("mkdir -p '{0}' && unshare -rm sh -c 'mount -t tmpfs -o size=64k none \"$1\" && "
                        "shift && exec \"$@\"' - '{0}' env POCL_CACHE_DIR='{0}' KREISEL_CACHE_DIR='{1}'",
                        file("full"), file("own")));
  if (a.code == 1 || a.code == 32) GTEST_SKIP() << "nothing may be mounted here: " << a.out;
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find(file("full") + " by POCL_CACHE_DIR, has no room"), std::string::npos) << a.out;
}

TEST_F(Endings, ADeviceWithoutDoublePrecisionWorksAndSaysSo) {
  const BenchAnswer a = bench(fmt::format("{} --precision single", tiny));
  EXPECT_EQ(a.code, 0) << a.out;
  EXPECT_NE(a.out.find("(single precision, compensated)"), std::string::npos) << a.out;
}

TEST_F(Endings, AnInfeasibleProblemSaysWhatIsOutOfReachAndByHowMuch) {
  // A cube, spun about an axis near an edge: hollowing cannot bring its centre of mass there. Its shell alone
  // holds more than half of the mass, so the centre stays within a quarter of the side from the middle.
  folder_.write("box.off",
                "OFF\n8 12 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n0 0 4\n4 0 4\n4 4 4\n0 4 4\n"
                "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n"
                "3 3 0 4\n3 3 4 7\n");
  const BenchAnswer a = bench(
      fmt::format("--model {} --contact 0.2,0.2,0 --resolution 12 --formulation voxel", file("box.off")));
  EXPECT_EQ(a.code, 3) << a.out;
  EXPECT_NE(a.out.find("  infeasible the centre of mass stays "), std::string::npos) << a.out;
  EXPECT_NE(a.out.find(" mm beside the axis"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("does not spin"), std::string::npos) << a.out;
}

class ShortOfMemory : public Endings {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer's shadow alone is beyond any limit";
#endif
  }

  /// @param megabytes  of address space; a run that hangs ends with 124
  [[nodiscard]] static BenchAnswer bench_within(unsigned megabytes, const std::string& arguments) {
    return bench(arguments, fmt::format("ulimit -v {}000; timeout -s KILL 100", megabytes));
  }
};

TEST_F(ShortOfMemory, SaysSoWhateverItIsShortFor) {
  // Libraries alone take 160 MB, PoCL 600 more, the solve 300 on top; what is reached depends on the machine.
  for (const unsigned megabytes : {200, 300, 500, 700, 800, 900, 1000, 1200})
    expect_one_line(bench_within(megabytes, "--formulation voxel --resolution 80 --device pocl"), 4,
                    "the limit on this process (ulimit -v) leaves");
}

TEST_F(ShortOfMemory, SaysSoWhenTheLinearSolverRunsOutOfIt) {
  // MUMPS is made to ask for a thousand times what it needs, which Ipopt alone calls a failed restoration.
  const unsigned megabytes = 1200 + 200 * std::max(1u, std::thread::hardware_concurrency());
  expect_one_line(bench_within(megabytes,
                               "--formulation voxel --resolution 40 --device pocl "
                               "--set ipopt.mumps_mem_percent=100000"),
                  4, "ran out of memory in Ipopt: the limit on this process (ulimit -v) leaves");
}

TEST_F(ShortOfMemory, StillSolvesWhatFits) {
  // With MUMPS' usual reserves of ten times the need it would take 1.8 GB on two cores.
  const unsigned megabytes = 1000 + 200 * std::max(1u, std::thread::hardware_concurrency());
  const BenchAnswer a =
      bench_within(megabytes, "--formulation voxel --resolution 80 --device pocl --set ipopt.max_iter=1");
  EXPECT_NE(a.out.find("maximum number of iterations exceeded"), std::string::npos) << a.out;
}

TEST_F(ShortOfMemory, TooManyVariablesAreRefusedBeforehand) {
  // 2 kB for each of the 1.2 million voxels are more than the limit; the grid itself takes a tenth of it.
  const BenchAnswer a =
      bench_within(2500, "--formulation voxel --resolution 184 --fineness 16 --device pocl");
  expect_one_line(a, 4, "GiB in Ipopt and the limit on this process (ulimit -v) leaves");
}

TEST_F(Endings, AFullDiskLeavesNoMesh) {
  const BenchAnswer a = bench(fmt::format("{} --mesh {}", tiny, file("part.stl")), "ulimit -f 8; ");
  expect_one_line(a, 2, "part.stl: writing ");
  EXPECT_NE(a.out.find("failed, expected room for them"), std::string::npos) << a.out;
  EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(Endings, AFullDiskLeavesTheEarlierMesh) {
  folder_.write("part.stl", "earlier");
  (void)bench(fmt::format("{} --mesh {}", tiny, file("part.stl")), "ulimit -f 8; ");
  EXPECT_EQ(files(), std::vector<std::string>{"part.stl"});
  EXPECT_EQ(fs::file_size(file("part.stl")), 7u);
}

TEST_F(Endings, AFullDiskLeavesNoJson) {
  const std::string arguments = fmt::format("inspect ellipsoid --fineness 8 --json {}", file("part.json"));
  ASSERT_EQ(bench(arguments).code, 0);  // and its kernels are compiled: their cache needs no room below
  fs::remove(file("part.json"));
  const BenchAnswer a = bench(arguments, "ulimit -f 1; ");
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find("bench: " + file("part.json") + ": writing "), std::string::npos) << a.out;
  EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(Endings, AFullDiskEndsAnExperimentWithoutAnyFileOfTheRun) {
  const fs::path toml = folder_.write(
      "trial.toml",
      "resolution = 24\nfineness = 16\nmesh = true\n[[run]]\nformulation = [\"rayrep\", \"voxel\"]\n");
  const BenchAnswer a =
      bench(fmt::format("run {} --results {}", toml.string(), file("runs")), "ulimit -f 8; ");
  // The mesh finds no room, which would go on record, which finds none either.
  EXPECT_EQ(a.code, 2) << a.out;
  EXPECT_NE(a.out.find(".h5: writing "), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("failed, expected room for them"), std::string::npos) << a.out;
  EXPECT_EQ(files(), std::vector<std::string>{"trial.toml"});
}

TEST_F(Endings, CtrlCKeepsTheFinishedRunsOfAnExperiment) {
  std::string lambdas;  // runs that differ, each of a fraction of a second: a minute or more of them
  for (int i = 0; i < 300; ++i) lambdas += fmt::format("{}{}", i ? ", " : "", 0.001 * i);
  const fs::path toml = folder_.write(
      "trial.toml",
      fmt::format("resolution = 32\nfineness = 16\nmesh = true\n[[run]]\nset.problem.lambda = [{}]\n",
                  lambdas));
  const BenchAnswer a =
      shell(interrupted_when(fmt::format("run {} --results {}", toml.string(), file("runs")),
                             fmt::format("ls {}/trial/*.h5 >/dev/null 2>&1", file("runs"))));
  EXPECT_EQ(a.code, 130) << a.out;
  EXPECT_NE(a.out.find("trial: interrupted, "), std::string::npos) << a.out;
  EXPECT_EQ(a.out.find('\r'), std::string::npos) << "no progress line in a pipe";
  std::size_t records = 0, meshes = 0;
  for (const auto& entry : fs::directory_iterator(folder_.path / "runs" / "trial")) {
    if (entry.path().extension() == ".h5") {
      ++records;
      EXPECT_EQ(read_record(entry.path()).error, "");
      EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".stl")));
    } else {
      ++meshes;
      EXPECT_EQ(entry.path().extension(), ".stl") << entry.path();
      EXPECT_EQ(entry.path().stem().extension(), "") << entry.path();
    }
  }
  EXPECT_GE(records, 1u);
  EXPECT_LT(records, 300u);
  EXPECT_EQ(meshes, records);
  const BenchAnswer left = bench(fmt::format("run {} --results {} --dry-run", toml.string(), file("runs")));
  EXPECT_NE(left.out.find(fmt::format("{} to run, {} finished", 300 - records, records)), std::string::npos)
      << left.out;
}

TEST_F(Endings, CtrlCWhileSolvingWritesNothing) {
  const std::string ready = file("ready");
  // Ipopt's own log says that it has begun. Without a bound on repetitions it would go on for hours.
  const BenchAnswer a = shell(interrupted_when(
      fmt::format(
          "{} --formulation voxel --resolution 48 --repeat 100000 --budget 100000 --set ipopt.output_file={} "
          "--set ipopt.file_print_level=5 --mesh {} --json {} --record {}",
          "--fineness 16", ready, file("a.stl"), file("a.json"), file("a.h5")),
      fmt::format("grep -q '^   1' {} 2>/dev/null", ready)));
  EXPECT_EQ(a.code, 130) << a.out;
  EXPECT_EQ(a.out, "bench: interrupted, nothing written\n");
  EXPECT_EQ(files(), std::vector<std::string>{"ready"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
