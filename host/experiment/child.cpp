#include "experiment/child.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "error.hpp"
#include "program/run_program.hpp"

namespace kreisel::core {
namespace fs = std::filesystem;

ChildEnd run_child(std::vector<std::string> words, const Limits& limits, bool quiet) {
  const ProgramEnd end = run_program({.words = std::move(words),
                                      .kept = quiet ? ProgramSpec::Kept::errors : ProgramSpec::Kept::nothing,
                                      .gigabytes = limits.gigabytes,
                                      .seconds = limits.seconds});
  const std::string limit = end.by == ProgramEnd::By::time     ? time_limit_text(limits)
                            : end.by == ProgramEnd::By::memory ? memory_limit_text(limits)
                                                               : "";
  return {limit, end.code, end.last_words};
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
