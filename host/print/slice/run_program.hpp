// run_program.hpp - a program of somebody else's, run without a shell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "control.hpp"

namespace kreisel::core {

struct ProgramEnd {
  int code = 0;           ///< its exit code; 128 + the signal that ended it
  bool in_time = true;    ///< false: it was ended, for it took too long
  std::string last_line;  ///< of what it wrote to standard output and error, or to the longest a screen shows
};

/// Runs it and waits for its end. What it writes is not seen, but for its last line.
/// @param words    the program, by its file or a name on the PATH, and its arguments
/// @param folder   for what it writes, and where it runs  @param seconds  it may take
/// @throws InputError   no such program  @throws Interrupted  it was ended
[[nodiscard]] ProgramEnd run_program(std::vector<std::string> words, const std::filesystem::path& folder,
                                     double seconds, const Control& control);

/// Whether a word names a program: a file that can be run, or a name on the PATH.
[[nodiscard]] bool is_program(const std::string& word);

}  // namespace kreisel::core
