// nest.hpp - `design nest`: shapes in each other.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/design/outputs.hpp"
#include "apps/shared/run_options.hpp"
#include "design/nested.hpp"

namespace kreisel::core::apps {

struct NestArguments {
  std::vector<std::string> models;
  RunOptions options;
  std::string wall = "2%";
  NestedSpec spec;
  DesignOutputs outputs;
  bool accept = false;  ///< done, though a wall or gap is less than was asked
};

void add_nest_options(CLI::App& app, NestArguments& arguments);

/// @return  the exit code
int nest_parts(NestArguments& arguments);

}  // namespace kreisel::core::apps
