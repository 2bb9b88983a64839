#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>

#include "apps/bench/commands.hpp"
#include "apps/shared/program.hpp"
#include "experiment/slurm.hpp"
#include "experiment/watch.hpp"

namespace kreisel::core::bench {
namespace {

namespace fs = std::filesystem;

/// @return  false where a stop was asked for meanwhile
bool pause(double seconds) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, apps::interruption(), std::chrono::duration<double>(seconds), [] { return false; });
  return !apps::interruption().stop_requested();
}

}  // namespace

int submit_experiment(const SubmitOptions& options) {
  const fs::path file = find_experiment(options.name);
  (void)experiment_of(options.name);  // what does not fit is told here, not in the log of a node
  std::error_code ignored;
  const ArrayJob job{.name = file.stem().string(),
                     .program = fs::read_symlink("/proc/self/exe", ignored),
                     .file = file,
                     .results = options.results,
                     .models = options.models,
                     .device = options.device,
                     .tasks = static_cast<std::size_t>(options.tasks),
                     .partition = options.partition,
                     .time = options.time};
  if (options.dry_run)
    fmt::print("{}", script_of(job));
  else
    submit(job);
  return done;
}

int watch_experiment(const WatchOptions& options) {
  Watch watch(experiment_of(options.name), options.results);
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  for (;;) {
    const Seen seen = watch.look();
    fmt::print("{}{}{}", terminal ? "\r\033[K" : "", text_of(seen), terminal && !seen.over() ? "" : "\n");
    std::fflush(stdout);
    if (seen.over()) return seen.failed > 0 ? not_converged : done;
    if (!terminal) return done;
    if (!pause(options.every)) break;
  }
  fmt::print("\n");
  return was_interrupted;
}

}  // namespace kreisel::core::bench
