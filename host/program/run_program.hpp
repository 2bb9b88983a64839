// run_program.hpp - a program of its own for what is not done in this one: run without a shell, watched, and
// ended at its limits.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

namespace kreisel::core {

struct ProgramSpec {
  std::vector<std::string> words;  ///< the program, by its file or a name on the PATH, and its arguments
  /// What of its output is kept for its last words: nothing, for it goes where ours goes; what it writes to
  /// its standard error; or all. What is not kept then is not seen.
  enum class Kept { nothing, errors, all } kept = Kept::nothing;
  double gigabytes = 0, seconds = 0;  ///< that it may take; 0: as it likes
  std::stop_token stop = {};          ///< ends it
};

struct ProgramEnd {
  enum class By { itself, time, memory, stop } by = By::itself;
  int code = 0;            ///< its exit code; 128 + the signal that ended it
  std::string last_words;  ///< the last line that was kept, as one line and no longer than a screen shows
};

/// Runs a program and waits for its end. Looks at its memory, the clock and the stop every 20 ms where there
/// are any of these, and kills it where it has passed one.
/// @throws InputError  no such program, or no room for what it says
[[nodiscard]] ProgramEnd run_program(ProgramSpec program);

/// Whether a word names a program: a file that can be run, or a name on the PATH.
[[nodiscard]] bool is_program(const std::string& word);

}  // namespace kreisel::core
