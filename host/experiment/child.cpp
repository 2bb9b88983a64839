#include "experiment/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <optional>
#include <thread>
#include <utility>

#include "error.hpp"
#include "stopwatch.hpp"

extern char** environ;

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

constexpr double gigabyte = 1e9;
constexpr auto look_every = std::chrono::milliseconds(20);

/// Bytes in use by a process; 0 once it has ended.
double memory_of(pid_t process) {
  double asked = 0, used = 0;  // the first two numbers of the file, pages
  std::ifstream(fmt::format("/proc/{}/statm", process)) >> asked >> used;
  return used * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Where a quiet child's standard error goes; gone with the object.
class Words {
 public:
  Words() {
    std::string name = (fs::temp_directory_path() / "kreisel-child-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file < 0)
      throw InputError(fmt::format("{}: {}, expected room for a file", name, std::strerror(errno)));
    ::close(file);
    path_ = name;
  }
  ~Words() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;

  [[nodiscard]] const char* path() const { return path_.c_str(); }
  [[nodiscard]] std::string last() const {
    std::ifstream stream(path_);
    std::string last;
    for (std::string line; std::getline(stream, line);)
      if (!line.empty()) last = line;
    return last;
  }

 private:
  fs::path path_;
};

pid_t start(std::vector<std::string>& words, const Words* silent) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (silent) {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, silent->path(), O_WRONLY | O_APPEND, 0);
  }
  pid_t child = 0;
  const int error = posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw InputError(fmt::format("{}: {}; expected a program", words[0], std::strerror(error)));
  return child;
}

}  // namespace

ChildEnd run_child(std::vector<std::string> words, const Limits& limits, bool quiet) {
  std::optional<Words> said;
  if (quiet) said.emplace();
  const Stopwatch watch;
  const pid_t child = start(words, said ? &*said : nullptr);
  ChildEnd end;
  const auto stop = [&](std::string why) {
    if (end.limit.empty()) ::kill(child, SIGKILL);
    end.limit = std::move(why);
  };
  int status = 0;
  rusage usage{};
  for (pid_t ended = 0; ended != child;) {
    ended = ::wait4(child, &status, limits.any() ? WNOHANG : 0, &usage);
    if (ended < 0 && errno != EINTR)
      throw InputError(fmt::format("{}: {}; expected its end", words[0], std::strerror(errno)));
    if (ended != 0) continue;
    if (limits.seconds > 0 && watch.seconds() > limits.seconds)
      stop(time_limit_text(limits));
    else if (limits.gigabytes > 0 && memory_of(child) > gigabyte * limits.gigabytes)
      stop(memory_limit_text(limits));
    std::this_thread::sleep_for(look_every);
  }
  // What it took between two looks.
  if (limits.gigabytes > 0 && 1024.0 * static_cast<double>(usage.ru_maxrss) > gigabyte * limits.gigabytes)
    end.limit = memory_limit_text(limits);
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (said) end.last_words = said->last();
  return end;
}

fs::path program_beside(const char* name) {
  std::error_code ignored;
  const fs::path here = fs::read_symlink("/proc/self/exe", ignored).parent_path(),
                 installed = here.parent_path() / KREISEL_LIBEXEC;
  for (const fs::path& folder : {here, installed})
    if (fs::exists(folder / name, ignored)) return folder / name;
  throw InputError(
      fmt::format("{}: no such file, nor in {}; expected the program {} (cmake --build FOLDER makes it)",
                  (here / name).string(), installed.string(), name));
}

}  // namespace kreisel::core
