// manual.hpp - a program's page for man(1), of the commands and options that it has.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace kreisel::core::apps {

/// The page as roff: one section a command, its options in the groups of its help.
[[nodiscard]] std::string manual(const CLI::App& app);

/// Answers `PROGRAM manual`, which no help lists: prints that page. cmake installs it.
[[nodiscard]] bool prints_manual(const CLI::App& app, int argc, char** argv);

}  // namespace kreisel::core::apps
