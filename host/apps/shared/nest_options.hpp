// nest_options.hpp - the fields of a nesting run as options of a command line.
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kreisel::core::apps {

/// @param given  where to put what is given: name of the field, and its text
/// @param some   names of fields; none: all there are
void add_nest_fields(CLI::App& app, std::vector<std::pair<std::string, std::string>>& given,
                     std::initializer_list<std::string_view> some = {});

}  // namespace kreisel::core::apps
