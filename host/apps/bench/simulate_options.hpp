// simulate_options.hpp - the options that `bench simulate` has of its own.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "apps/bench/commands.hpp"

namespace kreisel::core::bench {

/// @param give  takes a field of a run and its text (session/config.hpp)
void add_simulate_options(CLI::App& app, SimulateOptions& simulate,
                          const std::function<void(const std::string& field, const std::string& text)>& give);

}  // namespace kreisel::core::bench
