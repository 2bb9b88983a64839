// child.hpp - a program of its own for what is not to be done in this one: watched, and ended at its limits.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "run/limits.hpp"

namespace kreisel::core {

struct ChildEnd {
  std::string limit;       ///< the text of the limit that it met; empty: it ended by itself
  int code = 0;            ///< its exit code; 128 + the signal that ended it
  std::string last_words;  ///< the last line that a quiet one wrote to its standard error
};

/// Runs a program and waits for its end. Looks at its memory and the clock every 20 ms where there are
/// limits, and kills it where it has passed one.
///
/// @param words  the program, by its file or by a name on the PATH, and its arguments
/// @param quiet  its output is not seen, but for last_words
/// @throws InputError  no such program, or no room for what it says
[[nodiscard]] ChildEnd run_child(std::vector<std::string> words, const Limits& limits = {},
                                 bool quiet = false);

/// A program that lies beside this one, or where an installed one finds it. @throws InputError  in neither
[[nodiscard]] std::filesystem::path program_beside(const char* name);

}  // namespace kreisel::core
