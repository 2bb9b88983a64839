#include "apps/design/live.hpp"

#include <fmt/format.h>

#include "apps/shared/exit_code.hpp"
#include "error.hpp"

#ifdef KREISEL_LIVE
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "apps/shared/program.hpp"
#include "body/source.hpp"
#include "live/question.hpp"
#include "live/server.hpp"
#include "print/printer/printer.hpp"
#endif

namespace kreisel::core::apps {

void add_live_options(CLI::App& app, LiveArguments& arguments) {
  const RunKind& solve = find_run_kind("solve");
  app.add_option_function<std::string>(
         "MODEL", [&arguments](const std::string& name) { arguments.run.say("model", name); },
         "what to begin with: a name of `bench list`, or a mesh file; default one is chosen, or dropped, on "
         "the page")
      ->type_name("MODEL");
  arguments.run.add_some(app, {&solve},
                         {"problem", "unit", "weld", "close-holes", "inside-out", "pieces", "size",
                          "fineness", "density", "resolution", "device"});
  arguments.run.add(app, "--wall", "wall", "least wall: mm, or 2% (of the longest side), or 1.5h (cells)");
  app.add_option("--port", arguments.port, "of 127.0.0.1; default any that is free")
      ->check(CLI::Range(1, 65535));
  app.add_flag("--no-browser", arguments.no_browser, "print the address, and open nothing");
  app.add_option("--slicer", arguments.slicer,
                 "slices the parts that are made: prusa-slicer, cura-engine, or a command")
      ->type_name("NAME|COMMAND");
  app.add_option("--profile", arguments.profile, "settings of the slicer, key = value")->type_name("FILE");
  app.add_option("--printer", arguments.printer,
                 "who prints them; `design --printer list` names those that are known")
      ->type_name("NAME[@NOZZLE]");
}

#ifndef KREISEL_LIVE

int serve_page(const CLI::App&, const LiveArguments&) {
  throw InputError("live: built without it; expected a build with -DKREISEL_LIVE=ON (./setup.sh --live)");
}

#else

namespace {

/// Where there is a desktop. Nothing comes of it where there is no browser.
void open_browser(const std::string& url) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  std::thread([url] {
    std::string program = "xdg-open", address = url;
    char* const words[] = {program.data(), address.data(), nullptr};
    pid_t child = 0;
    if (::posix_spawnp(&child, "xdg-open", nullptr, nullptr, words, environ) == 0)
      ::waitpid(child, nullptr, 0);
  }).detach();
}

std::shared_ptr<const live::Setup> setup_of(const CLI::App& app, const LiveArguments& arguments) {
  auto setup = std::make_shared<live::Setup>();
  setup->usual = live::usual_question();
  arguments.run.apply(setup->usual);
  if (app.count("MODEL") > 0) {
    setup->given = setup->usual.body;
    require_known_source(*setup->given);
    if (is_absent_file(setup->given->model))
      throw InputError(fmt::format("{}: no such file, expected a mesh", setup->given->model));
  }
  setup->slicing.slicer = arguments.slicer;
  setup->slicing.profile = arguments.profile;
  if (!arguments.printer.empty()) setup->slicing.printer = find_printer(arguments.printer);
  return setup;
}

}  // namespace

int serve_page(const CLI::App& app, const LiveArguments& arguments) {
  live::serve(
      setup_of(app, arguments), static_cast<std::uint16_t>(arguments.port),
      [&](const std::string& url) {
        fmt::print("{}\n", url);
        std::fflush(stdout);  // whoever reads a pipe waits for it
        if (!arguments.no_browser) open_browser(url);
      },
      interruption());
  return done;
}

#endif

}  // namespace kreisel::core::apps
