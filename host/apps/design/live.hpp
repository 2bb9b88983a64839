// live.hpp - `design live`: a page in the browser, served by this program.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/shared/run_options.hpp"

namespace kreisel::core::apps {

struct LiveArguments {
  RunOptions run;
  int port = 0;
  bool no_browser = false;
  std::string slicer, profile, printer;
};

void add_live_options(CLI::App& app, LiveArguments& arguments);

/// Serves until Ctrl-C. @return  the exit code
[[nodiscard]] int serve_page(const CLI::App& app, const LiveArguments& arguments);

}  // namespace kreisel::core::apps
