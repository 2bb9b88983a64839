// child.hpp - a run in a program of its own, ended at the limits of the run.
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

/// Runs a program (run_program()) within the limits of a run.
/// @param quiet  its output is not seen, but for last_words
[[nodiscard]] ChildEnd run_child(std::vector<std::string> words, const Limits& limits = {},
                                 bool quiet = false);

/// A program that lies beside this one, or where an installed one finds it. @throws InputError  in neither
[[nodiscard]] std::filesystem::path program_beside(const char* name);

}  // namespace kreisel::core
