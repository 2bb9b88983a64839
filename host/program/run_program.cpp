#include "program/run_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include "error.hpp"
#include "stopwatch.hpp"

extern char** environ;

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;
using By = ProgramEnd::By;
using Kept = ProgramSpec::Kept;

constexpr double gigabyte = 1e9;
constexpr auto look_every = std::chrono::milliseconds(20);

/// Bytes in use by a process; 0 once it has ended.
double memory_of(pid_t process) {
  double asked = 0, used = 0;  // the first two numbers of the file, pages
  std::ifstream(fmt::format("/proc/{}/statm", process)) >> asked >> used;
  return used * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Where what a program says is kept; gone with the object.
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
    constexpr std::size_t longest = 300;
    std::ifstream stream(path_);
    std::string last;
    for (std::string line; std::getline(stream, line);)
      if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    last.resize(std::min(last.size(), longest));
    for (char& c : last)
      if (c >= 0 && c < ' ') c = ' ';
    return last;
  }

 private:
  fs::path path_;
};

pid_t start(ProgramSpec& program, const Words* words) {
  std::vector<char*> arguments;
  for (std::string& word : program.words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (words) {
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, words->path(), O_WRONLY | O_APPEND, 0);
    if (program.kept == Kept::all)
      posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    else
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  pid_t child = 0;
  const std::string& name = program.words.front();
  const int error = posix_spawnp(&child, name.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw InputError(fmt::format("{}: {}; expected a program", name, std::strerror(error)));
  return child;
}

}  // namespace

ProgramEnd run_program(ProgramSpec program) {
  std::optional<Words> words;
  if (program.kept != Kept::nothing) words.emplace();
  const Stopwatch watch;
  const pid_t child = start(program, words ? &*words : nullptr);
  const bool watched = program.gigabytes > 0 || program.seconds > 0 || program.stop.stop_possible();
  ProgramEnd end;
  const auto passed = [&] {
    return program.stop.stop_requested()                                              ? By::stop
           : program.seconds > 0 && watch.seconds() > program.seconds                 ? By::time
           : program.gigabytes > 0 && memory_of(child) > gigabyte * program.gigabytes ? By::memory
                                                                                      : By::itself;
  };
  int status = 0;
  rusage usage{};
  for (pid_t ended = 0; ended != child;) {
    ended = ::wait4(child, &status, watched ? WNOHANG : 0, &usage);
    if (ended < 0 && errno != EINTR)
      throw InputError(fmt::format("{}: {}; expected its end", program.words.front(), std::strerror(errno)));
    if (ended != 0) continue;
    if (end.by == By::itself && (end.by = passed()) != By::itself) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(look_every);
  }
  // What it took between two looks.
  if (program.gigabytes > 0 && 1024.0 * static_cast<double>(usage.ru_maxrss) > gigabyte * program.gigabytes)
    end.by = By::memory;
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (words) end.last_words = words->last();
  return end;
}

bool is_program(const std::string& word) {
  const auto runs = [](const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
  };
  if (word.find('/') != std::string::npos) return runs(word);
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (runs(fs::path(folder.empty() ? "." : folder) / word)) return true;
  return false;
}

}  // namespace kreisel::core
