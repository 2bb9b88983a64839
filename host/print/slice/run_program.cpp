#include "print/slice/run_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include "error.hpp"
#include "stopwatch.hpp"

extern char** environ;

namespace kreisel::core {
namespace {

namespace fs = std::filesystem;

constexpr auto look_every = std::chrono::milliseconds(20);
constexpr std::size_t longest_line = 300;

std::string last_line_of(const fs::path& file) {
  std::ifstream stream(file);
  std::string last;
  for (std::string line; std::getline(stream, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  last.resize(std::min(last.size(), longest_line));
  for (char& c : last)
    if (c >= 0 && c < ' ') c = ' ';
  return last;
}

pid_t start(std::vector<std::string>& words, const fs::path& output) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                   0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw InputError(fmt::format("{}: {}, expected a program", words[0], std::strerror(error)));
  return child;
}

}  // namespace

ProgramEnd run_program(std::vector<std::string> words, const fs::path& folder, double seconds,
                       const Control& control) {
  const fs::path output = folder / "said.txt";
  const Stopwatch watch;
  const pid_t child = start(words, output);
  ProgramEnd end;
  int status = 0;
  bool killed = false;
  for (pid_t ended = 0; ended != child;) {
    ended = ::waitpid(child, &status, WNOHANG);
    if (ended < 0 && errno != EINTR)
      throw InputError(fmt::format("{}: {}, expected its end", words[0], std::strerror(errno)));
    if (ended == child) break;
    end.in_time = end.in_time && watch.seconds() < seconds;
    if (!killed && (!end.in_time || control.stopped())) {
      ::kill(child, SIGKILL);
      killed = true;
    }
    std::this_thread::sleep_for(look_every);
  }
  control.stop_if_asked();
  end.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  end.last_line = last_line_of(output);
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
