// completion.hpp - what may stand next on a command line, as a shell asks.
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <vector>

#include "settings/field.hpp"

namespace kreisel::core::apps {

/// Says what the value of an option may be, beside what its type does: FILE and FOLDER are files.
void offer(CLI::Option* option, Choices choices);

/// What may stand in the place of the last word; "/": files, too. Goes by the options and commands of the
/// program alone.
/// @param words  after the program's name; bash splits some at = and :
[[nodiscard]] std::vector<std::string> candidates(const CLI::App& app, std::span<const std::string> words);

/// The command `completion SHELL`, which prints a script for bash, zsh or fish.
CLI::App* add_completion(CLI::App& app);

/// Answers such a script, where that is what was called: `PROGRAM complete WORDS...`, which no help lists.
[[nodiscard]] bool completes(const CLI::App& app, int argc, char** argv);

}  // namespace kreisel::core::apps
