#include "experiment/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>

#include "error.hpp"
#include "experiment/child.hpp"
#include "file/write_text.hpp"
#include "words.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;
namespace {

/// It goes into a line of the script that Slurm reads, where nothing is quoted.
void require_plain(const char* option, const std::string& text, std::string_view characters,
                   const char* expected) {
  if (text.find_first_not_of(characters) != text.npos)
    throw InputError(fmt::format("{} {}: expected {}", option, text, expected));
}

constexpr std::string_view of_names = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.,";
constexpr std::string_view of_times = "0123456789:-";

/// A run that outlasts the task's time and cannot be kept would go round for ever.
constexpr int most_restarts = 100;

/// USR1 comes a minute before the time is over: what can be kept is, and the task is queued again. TERM comes
/// from whoever ends the job.
constexpr const char* out_of_time = R"(stop() {{ kill -TERM $share; wait $share; }}
again() {{
  stop
  [ "${{SLURM_RESTART_COUNT:-0}}" -lt {} ] && exec scontrol requeue "$SLURM_JOB_ID"
}}
trap 'again; exit 130' USR1
trap 'stop; exit 130' TERM
)";

fs::path whole_path(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

}  // namespace

fs::path job_folder(const ArrayJob& job) { return whole_path(job.results / job.name / "slurm"); }

std::string script_of(const ArrayJob& job) {
  if (job.tasks < 1) throw InputError("--tasks 0: expected at least one");
  require_plain("--partition", job.partition, of_names, "names of partitions, with commas between them");
  require_plain("--time", job.time, of_times, "minutes, or days-hours:minutes:seconds");
  std::string words =
      fmt::format("{} run {} --results {}", shell_word(whole_path(job.program).string()),
                  shell_word(whole_path(job.file).string()), shell_word(whole_path(job.results).string()));
  if (!job.models.empty()) words += " --models " + shell_word(whole_path(job.models).string());
  if (!job.device.empty()) words += " --device " + shell_word(job.device);
  std::string script = "#!/bin/bash\n";
  const auto say = [&](const std::string& option) { script += "#SBATCH " + option + '\n'; };
  std::string plain = job.name;
  std::ranges::replace_if(
      plain, [](unsigned char c) { return !std::isalnum(c) && c != '_' && c != '-'; }, '-');
  say("--job-name=" + plain);
  say(fmt::format("--array=1-{}", job.tasks));
  say("--ntasks=1");
  say("--cpus-per-task=1");
  if (!job.partition.empty()) say("--partition=" + job.partition);
  if (!job.time.empty()) say("--time=" + job.time);
  say("--requeue");
  say("--signal=B:USR1@60");
  say("--open-mode=append");
  // Kernels are compiled once a node; a home that all nodes share would be written by all of them at once.
  script += "export POCL_CACHE_DIR=\"${TMPDIR:-/tmp}/kreisel-pocl-$(id -u)\"\n";
  script += "mkdir -p \"$POCL_CACHE_DIR\"\n";
  script += fmt::format(out_of_time, most_restarts);
  script +=
      fmt::format("{} --shard \"$SLURM_ARRAY_TASK_ID/{}\" &\nshare=$!\nwait $share\n", words, job.tasks);
  return script;
}

void submit(const ArrayJob& job) {
  const std::string script = script_of(job);
  const fs::path folder = job_folder(job), file = folder / "job.sh";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(fmt::format("{}: {}; expected a folder for results", folder.string(), error.message()));
  write_text(file, script);
  ChildEnd end;
  try {
    // Not in the script: its lines cannot quote a folder's name.
    end = run_child({"sbatch", "--output=" + (folder / "%A_%a.txt").string(), file.string()});
  } catch (const InputError&) {
    throw InputError(
        fmt::format("sbatch: not on the PATH; expected Slurm's (the job is written: {})", file.string()));
  }
  if (end.code != 0)
    throw InputError(
        fmt::format("sbatch refused {} (code {}); expected a partition and a time that this cluster has",
                    file.string(), end.code));
}

}  // namespace kreisel::core
