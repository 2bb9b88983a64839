// slurm.hpp - an experiment as an array job of Slurm, a task a shard.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace kreisel::core {

struct ArrayJob {
  std::string name;               ///< of the experiment
  std::filesystem::path program;  ///< `bench`
  std::filesystem::path file;     ///< of the experiment
  std::filesystem::path results;  ///< as RunnerOptions::results
  std::filesystem::path models;   ///< folder of mesh files; empty: the environment's
  std::string device;             ///< of every run; empty: each its own
  std::size_t tasks = 8;
  std::string partition, time;  ///< as sbatch takes them; empty: the cluster's own
};

/// Where the job's script and what its tasks print lie.
[[nodiscard]] std::filesystem::path job_folder(const ArrayJob& job);

/// The script. A task is `bench run --shard I/N` on one core. It is told to stop a minute before its time is
/// over. Then, and after a node fails, it is queued again, and goes on with what is not on record yet.
/// @throws InputError  no task, a partition or time that Slurm would not take
[[nodiscard]] std::string script_of(const ArrayJob& job);

/// Writes the script and hands it to Slurm, which prints the job's number.
/// @throws InputError  as script_of(), no folder to write to, no sbatch on the PATH, or one that refused and
/// has
///                     said why
void submit(const ArrayJob& job);

}  // namespace kreisel::core
