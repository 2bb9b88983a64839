// program.hpp - what every program does around its work: Ctrl-C, one line for an error, the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <stop_token>
#include <string>

namespace kreisel::core::apps {

/// One line for what CLI11 refuses: of an unknown option or command its name and the nearest that there is.
[[nodiscard]] std::string explained(const CLI::App& app, const CLI::ParseError& error);

/// Asked for by the first SIGINT or SIGTERM since run_program(); a second one ends the program at once, as
/// does a second's wait, then without the temporary files.
[[nodiscard]] std::stop_token interruption();

/// Ends the process with what `dispatch` returns, or with one line and the code of what it throws.
/// @param name  of the program, ahead of that line
[[noreturn]] void run_program(const char* name, int (*dispatch)(int argc, char** argv), int argc,
                              char** argv);

}  // namespace kreisel::core::apps
