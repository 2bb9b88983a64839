#include "experiment/outside_nesting.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "error.hpp"
#include "experiment/run_text.hpp"
#include "record/nest_record.hpp"

extern char** environ;

namespace kreisel {
namespace {

namespace fs = std::filesystem;

constexpr int interrupted_code = 130;

fs::path program() {
  std::error_code ignored;
  const fs::path path = fs::read_symlink("/proc/self/exe", ignored).parent_path() / "nest_baseline";
  if (!fs::exists(path, ignored))
    throw InputError(
        fmt::format("{}: no such file; expected the program with pagmo's searches", path.string()));
  return path;
}

std::vector<std::string> words_of(const NestConfig& config, const fs::path& record) {
  std::vector<std::string> words = {program().string(), "--record", record.string()};
  for (const auto& [field, text] : describe(config)) {
    words.push_back("--" + field);
    // Several words are several arguments.
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t space = std::min(text.find(' ', at), text.size());
      words.push_back(text.substr(at, space - at));
      at = space + 1;
    }
  }
  if (!config.device.empty()) words.insert(words.end(), {"--device", config.device});
  return words;
}

}  // namespace

void OutsideNesting::run(const Progress& progress) {
  if (progress) progress("by nest_baseline");
  std::vector<std::string> words = words_of(*run_.run.nest, run_.record);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (const int error = posix_spawn(&child, words[0].c_str(), nullptr, nullptr, arguments.data(), environ))
    throw InputError(fmt::format("{}: {}; expected a program", words[0], std::strerror(error)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : interrupted_code;
  whole_ = code != interrupted_code;
  if (whole_ && code != 0)
    throw InputError(fmt::format("nest_baseline ended with code {}, and said why", code));
}

std::string OutsideNesting::text() const {
  const NestSummary nest = read_nest(run_.record);
  return fmt::format("{}: {}, scale {:.4f}, {} evaluations, {:.3g} s", run_text(run_.run), nest.termination,
                     nest.scale, nest.evaluations, nest.search_seconds);
}

}  // namespace kreisel
