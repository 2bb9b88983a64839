// main.cpp - `design`: argument parsing only.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "apps/design/print.hpp"
#include "apps/shared/exit_code.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/program.hpp"
#include "apps/shared/run_options.hpp"
#include "apps/shared/step_line.hpp"
#include "design/page.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "mesh/format.hpp"
#include "run/build_info.hpp"

namespace {

using kreisel::InputError;
using namespace kreisel::apps;

/// What `design` can make: a problem, what it says in --help, the options it has of its own.
struct Purpose {
  const char *problem, *help;
  std::initializer_list<std::string_view> fields;
};

const Purpose purposes[] = {
    {"spin", "a spinning top: it spins about the axis", {"axis", "contact"}},
    {"yoyo", "a yo-yo: it spins about its axle", {"axis", "contact", "axle", "slot", "axle-depth"}},
    {"stand", "it stands on what is lowest", {"up", "problem.target"}},
    {"float", "it floats upright at a given draft", {"up", "problem.draft", "problem.fluid_density"}},
};

struct Parsed {
  RunOptions run;
  kreisel::DesignSpec spec;
  std::string output, json_file, html_file;
  bool force = false;
};

void add_options(CLI::App& app, Parsed& parsed, const Purpose& purpose) {
  RunOptions& run = parsed.run;
  run.add(app, {"model"});
  app.add_option("-o,--output", parsed.output, "the part: .stl, .3mf (with units), .obj, .ply or .off, mm")
      ->required();
  run.add(app, purpose.fields);
  run.add(app, "--wall", "wall", "least wall: mm, or 2% (of the longest side, the default), or 1.5h (cells)");
  run.add(app, {"unit", "size", "density", "interior-density", "void-density", "fineness", "device"});
  run.add(app, "--resolution", "resolution", "cells along the longest side; default 128");
  run.add(app, "--formulation", "formulation", "how the interior is described; default quadric");
  run.add_settings(app, "GROUP.NAME=VALUE, as for `bench`");
  app.add_option("--printer-accuracy", parsed.spec.printer_accuracy,
                 "mm; a wall thinner than this is refused, a void smaller than the cube of five times this "
                 "stays filled")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option(
      "--cut", parsed.spec.cut,
      "cut the part: auto (by the planes that open its voids), or a plane NX,NY,NZ,D, N . x = D in mm");
  app.add_option("--pegs", parsed.spec.peg_radius,
                 "radius of two loose pins that align the halves of a cut, mm; default none")
      ->check(CLI::PositiveNumber);
  app.add_option("--drain", parsed.spec.drain_radius,
                 "radius of a hole from every void to the outside, mm; default none")
      ->check(CLI::PositiveNumber);
  app.add_option("--json", parsed.json_file, "write a report as JSON; - for standard output");
  app.add_option("--html", parsed.html_file,
                 "write a page with a view of it, a cut to move, and the numbers");
  app.add_flag("--force", parsed.force, "write over files that exist");
}

void require_writable(const Parsed& parsed) {
  (void)kreisel::mesh_format(parsed.output);
  for (const auto& [file, option] :
       {std::pair{parsed.output, "--output"}, std::pair{parsed.json_file, "--json"},
        std::pair{parsed.html_file, "--html"}}) {
    kreisel::apps::require_writable(file, option);
    if (!parsed.force && !file.empty() && file != "-" && std::filesystem::exists(file))
      throw InputError(fmt::format("{} {} exists; expected a new name, or --force", option, file));
  }
}

int make(Parsed& parsed, const std::string& problem) {
  kreisel::RunConfig& config = parsed.spec.config;
  config.problem = problem;
  config.formulation = "quadric";
  config.grid.resolution = 128;
  config.wall = kreisel::parse_wall("2%");
  parsed.run.apply(config);
  require_writable(parsed);
  const std::string three = parsed.html_file.empty() ? "" : kreisel::installed_three();
  parsed.spec.file = parsed.output;
  const kreisel::Design design = [&] {
    const StepLine line;
    return make_design(parsed.spec, [&](const std::string& step) { line.show(step); });
  }();
  if (!parsed.html_file.empty() && design.feasible())
    kreisel::write_text(parsed.html_file, page_of(design, three));
  const std::string json = to_json(design);
  if (parsed.json_file == "-") {
    fmt::print("{}", json);  // alone on standard output, for a pipe
  } else {
    if (!parsed.json_file.empty()) kreisel::write_text(parsed.json_file, json);
    print_design(design);
  }
  return exit_code(design.run.outcome.termination);
}

int dispatch(int argc, char** argv) {
  CLI::App app("Kreisel: a mesh in, a printable part out that spins, stands or floats", "design");
  app.set_version_flag(
      "--version", fmt::format("kreisel {} ({})", kreisel::build_info::version, kreisel::build_info::commit));
  app.require_subcommand(0, 1);
  Parsed parsed;
  for (const Purpose& purpose : purposes)
    add_options(*app.add_subcommand(purpose.problem, purpose.help), parsed, purpose);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    throw InputError(explained(app, error));
  }
  if (app.get_subcommands().empty()) {
    fmt::print("{}", app.help());
    return done;
  }
  return make(parsed, app.get_subcommands().front()->get_name());
}

}  // namespace

int main(int argc, char** argv) { run_program("design", dispatch, argc, argv); }
