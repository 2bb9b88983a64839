// nest_options.hpp - the command line of `bench nest`: every field of a nesting run is an option.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace kreisel::bench {

/// @param given  where to put what is given: name of the field, and its text
void add_nest_fields(CLI::App& app, std::vector<std::pair<std::string, std::string>>& given);

}  // namespace kreisel::bench
