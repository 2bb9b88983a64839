// slurm_test.cpp - the script of an array job: what Slurm and a shell make of it.
#include "experiment/slurm.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "apps/run_bench.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

ArrayJob job() {
  ArrayJob all;
  all.name = "wall";
  all.program = "/opt/kreisel/bin/bench";
  all.file = "/home/me/wall.toml";
  all.results = "/data/runs";
  return all;
}

TEST(ArrayJob, IsATaskAShardThatIsQueuedAgain) {
  ArrayJob asked = job();
  asked.tasks = 16;
  asked.partition = "short,long";
  asked.time = "1-12:00:00";
  const std::string script = script_of(asked);
  EXPECT_EQ(script.find("#!/bin/bash\n#SBATCH "), 0u);
  for (const char* line :
       {"#SBATCH --array=1-16\n", "#SBATCH --requeue\n", "#SBATCH --partition=short,long\n",
        "#SBATCH --time=1-12:00:00\n", "#SBATCH --job-name=wall\n", "#SBATCH --cpus-per-task=1\n",
        "\n/opt/kreisel/bin/bench run /home/me/wall.toml --results /data/runs --shard "
        "\"$SLURM_ARRAY_TASK_ID/16\" &\n"})
    EXPECT_NE(script.find(line), std::string::npos) << line << script;
  EXPECT_EQ(script_of(job()).find("--partition"), std::string::npos) << "the cluster's own";
}

TEST(ArrayJob, AShellReadsAnyNameAsItIs) {
  const TemporaryFolder folder;
  const std::string odd = (folder.path / "it's $HOME; `ls` \"x\" *").string();
  std::filesystem::create_directory(odd);
  ArrayJob asked = job();
  asked.file = odd + "/wall.toml";
  asked.results = odd;
  asked.models = odd;
  asked.device = "a'b";
  asked.name = "odd name\nof it";
  asked.program = folder.path / "bench";
  std::ofstream(asked.program) << "#!/bin/sh\nprintf '%s\\n' \"$@\"\n";
  std::filesystem::permissions(asked.program, std::filesystem::perms::owner_all);
  std::ofstream(folder.path / "job.sh") << script_of(asked);
  const BenchAnswer said =
      shell(fmt::format("SLURM_ARRAY_TASK_ID=3 bash '{}'", (folder.path / "job.sh").string()));
  EXPECT_EQ(
      said.out,
      fmt::format("run\n{0}/wall.toml\n--results\n{0}\n--models\n{0}\n--device\na'b\n--shard\n3/8\n", odd));
  EXPECT_NE(script_of(asked).find("--job-name=odd-name-of-it\n"), std::string::npos);
}

TEST(ArrayJob, OutOfTimeItStopsItsShareAndIsQueuedAgain) {
  const TemporaryFolder folder;
  ArrayJob asked = job();
  asked.program = folder.path / "bench";
  const auto program = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path / name) << "#!/bin/bash\n" << text;
    std::filesystem::permissions(folder.path / name, std::filesystem::perms::owner_all);
  };
  // A share that ends when it is told to, and an engine that says what it is asked.
  program("bench", "trap 'echo kept; exit 130' TERM\n: > \"$0.began\"\nwhile :; do sleep 0.05; done\n");
  program("scontrol", "echo scontrol \"$@\"\n");
  std::ofstream(folder.path / "job.sh") << script_of(asked);
  const auto told = [&](const std::string& signal, int restarts) {
    return shell(fmt::format(
        "cd '{0}' && rm -f bench.began; PATH=\"$PWD:$PATH\" SLURM_ARRAY_TASK_ID=1 SLURM_JOB_ID=77 "
        "SLURM_RESTART_COUNT={1} bash job.sh & until [ -e '{0}/bench.began' ]; do sleep 0.05; "
        "done; kill -{2} $!; wait $!",
        folder.path.string(), restarts, signal));
  };
  EXPECT_EQ(told("USR1", 3).out, "kept\nscontrol requeue 77\n");
  EXPECT_EQ(told("USR1", 100).out, "kept\n") << "not for ever";
  EXPECT_EQ(told("TERM", 0).out, "kept\n") << "someone ended the job";
}

TEST(ArrayJob, WhatSlurmWouldNotTakeIsRefused) {
  ArrayJob asked = job();
  asked.partition = "a b";
  expect_refusal([&] { (void)script_of(asked); }, "--partition a b: ", {"expected names of partitions"});
  asked = job();
  asked.time = "1h";
  expect_refusal([&] { (void)script_of(asked); }, "--time 1h: ", {"expected minutes"});
  asked = job();
  asked.tasks = 0;
  expect_refusal([&] { (void)script_of(asked); }, "--tasks 0: ", {});
}

TEST(ArrayJob, IsHandedToSbatchWithItsFolder) {
  const TemporaryFolder folder;
  ArrayJob asked = job();
  asked.results = folder.path / "runs";
  const std::string before = fmt::format("PATH='{}':", folder.path.string());
  // One that says what it was given.
  std::ofstream(folder.path / "sbatch") << "#!/bin/sh\necho \"$@\" > \"$(dirname \"$0\")/given\"\n";
  std::filesystem::permissions(folder.path / "sbatch", std::filesystem::perms::owner_all);
  std::ofstream(folder.path / "two.toml") << "[[run]]\nmodel = ['ellipsoid', 'bird']\n";
  const std::string submit = fmt::format("submit '{}/two.toml' --slurm --tasks 2 --results '{}'",
                                         folder.path.string(), asked.results.string());
  EXPECT_EQ(bench(submit, before + "$PATH").code, 0);
  std::ifstream given(folder.path / "given");
  std::string text;
  std::getline(given, text);
  const std::string slurm = (asked.results / "two" / "slurm").string();
  EXPECT_EQ(text, fmt::format("--output={0}/%A_%a.txt {0}/job.sh", slurm));
  EXPECT_TRUE(std::filesystem::exists(slurm + "/job.sh"));

  std::ofstream(folder.path / "sbatch") << "#!/bin/sh\necho 'invalid partition' >&2\nexit 1\n";
  const BenchAnswer refused = bench(submit, before + "$PATH");
  EXPECT_EQ(refused.code, 2) << refused.out;
  EXPECT_NE(refused.out.find("invalid partition"), std::string::npos) << refused.out;
  EXPECT_NE(refused.out.find("sbatch refused "), std::string::npos) << refused.out;

  const BenchAnswer none = bench(submit, fmt::format("PATH='{}'", slurm));
  EXPECT_EQ(none.code, 2) << none.out;
  EXPECT_NE(none.out.find("sbatch: not on the PATH; expected Slurm's"), std::string::npos) << none.out;
  const BenchAnswer dry = bench(submit + " --dry-run");
  EXPECT_EQ(dry.code, 0);
  EXPECT_EQ(dry.out.find("#!/bin/bash\n"), 0u) << dry.out;
  EXPECT_EQ(bench("submit nothing --slurm").code, 2);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
