// main.cpp - `design`: argument parsing only.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string>

#include "apps/design/nest.hpp"
#include "apps/design/outputs.hpp"
#include "apps/design/print.hpp"
#include "apps/shared/completion.hpp"
#include "apps/shared/exit_code.hpp"
#include "apps/shared/program.hpp"
#include "apps/shared/run_options.hpp"
#include "apps/shared/step_line.hpp"
#include "design/page.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "session/build_info.hpp"

namespace {

using kreisel::core::InputError;
using kreisel::core::RunKind;
using namespace kreisel::core::apps;

/// What `design` can make: a problem, what it says in --help, the options it has of its own, and what they
/// are where a maker is better served by other ones than a researcher.
struct Purpose {
  const char *problem, *help;
  std::initializer_list<std::string_view> fields;
  std::map<std::string, std::string> settings = {};
};

const Purpose purposes[] = {
    {"spin", "a spinning top: it spins about the axis", {"axis", "contact", "stem", "tip"}},
    {"yoyo", "a yo-yo: it spins about its axle", {"axis", "contact", "axle", "slot", "axle-depth"}},
    {"stand",
     "it stands on what is lowest",
     {"up", "flatten", "problem.target"},
     {{"problem.target", "max-tilt"}}},
    {"balance", "its centre of mass is at a point, or on a line", {"up", "problem.point", "problem.line"}},
    {"hang", "hung from a point it keeps its pose", {"problem.point", "problem.line"}},
    {"die", "a fair die: its faces come up alike", {}},
    {"float", "it floats upright at a given draft", {"up", "problem.draft", "problem.fluid_density"}},
};

struct Parsed {
  RunOptions run;
  kreisel::core::DesignSpec spec;
  DesignOutputs outputs;
  bool accept = false;
  NestArguments nest;
};

void add_options(CLI::App& app, Parsed& parsed, const Purpose& purpose) {
  RunOptions& run = parsed.run;
  const RunKind& solve = kreisel::core::find_run_kind("solve");
  run.add_model(app);
  parsed.outputs.add(app, "the part");
  if (purpose.fields.size() > 0) run.add(app, {&solve}, purpose.fields);  // none would be all
  if (std::ranges::find(purpose.fields, "stem") != purpose.fields.end())
    run.add(
        app, "--through", "axis-through",
        "where an axis that is found runs: lowest (point along it) or centre (of mass, on a stem); default "
        "lowest, else centre");
  run.add(app, "--wall", "wall", "least wall: mm, or 2% (of the longest side, the default), or 1.5h (cells)");
  run.add(app, {&solve},
          {"unit", "weld", "size", "density", "interior-density", "void-density", "fineness", "device"});
  run.add(app, "--resolution", "resolution", "cells along the longest side; default 128");
  run.add(app, "--formulation", "formulation", "how the interior is described; default quadric");
  run.add_settings(app, solve);
  app.add_option("--printer-accuracy", parsed.spec.printer_accuracy,
                 "mm; a wall thinner than this is refused, a void smaller than the cube of five times this "
                 "stays filled")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option(
      "--cut", parsed.spec.cut,
      "cut the part: auto (by the planes that open its voids), or a plane NX,NY,NZ,D, N . x = D in mm");
  app.add_flag("--lay-flat", parsed.spec.lay_flat,
               "write the pieces of a cut beside each other, each lying on its cut");
  app.add_option("--pegs", parsed.spec.peg_radius,
                 "radius of two loose pins that align the halves of a cut, mm; default none")
      ->check(CLI::PositiveNumber);
  app.add_flag(
      "--mould", parsed.spec.mould,
      "write moulds, too, for what of the part is denser than its shell: two halves, sprue, vents, pins");
  app.add_flag("--accept", parsed.accept, "exit code 0, though the part does not do what was asked");
  app.add_option("--drain", parsed.spec.drain_radius,
                 "radius of a hole from every void to the outside, mm; default none")
      ->check(CLI::PositiveNumber);
}

int make(Parsed& parsed, const Purpose& purpose) {
  kreisel::core::RunConfig& config = parsed.spec.config;
  config.problem = purpose.problem;
  config.formulation = "quadric";
  config.grid.resolution = 128;
  config.wall = kreisel::core::parse_wall("2%");
  config.settings = purpose.settings;
  parsed.run.apply(config);
  const DesignOutputs& outputs = parsed.outputs;
  outputs.require_writable();
  const std::string three = outputs.html.empty() ? "" : kreisel::core::installed_three();
  parsed.spec.file = outputs.part;
  const kreisel::core::Design design = [&] {
    const StepLine line;
    kreisel::core::Session session;
    return make_design(session, parsed.spec, line.control());
  }();
  if (!outputs.html.empty() && design.feasible())
    kreisel::core::write_text(outputs.html, page_of(design, three));
  if (outputs.write_report(to_json(design))) print_design(design);
  const bool misses = design.feasible() && !design.run.verified.verdict.ok && !parsed.accept;
  const int ending = exit_code(design.run.outcome.termination);
  return ending == done && misses ? not_as_asked : ending;
}

int dispatch(int argc, char** argv) {
  CLI::App app("Kreisel: a mesh in, a printable part out that spins, stands, floats or nests", "design");
  app.set_version_flag("--version", fmt::format("kreisel {} ({})", kreisel::core::build_info::version,
                                                kreisel::core::build_info::commit));
  app.require_subcommand(0, 1);
  Parsed parsed;
  for (const Purpose& purpose : purposes)
    add_options(*app.add_subcommand(purpose.problem, purpose.help), parsed, purpose);
  CLI::App* nested =
      app.add_subcommand("nest", "a nested doll: halves that come apart, around shapes as large as fit");
  add_nest_options(*nested, parsed.nest);
  const CLI::App* completion = add_completion(app);
  if (completes(app, argc, argv)) return done;
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
  if (*completion) return done;
  if (*nested) return nest_parts(parsed.nest);
  const std::string asked = app.get_subcommands().front()->get_name();
  return make(parsed, *std::ranges::find_if(purposes, [&](const Purpose& p) { return p.problem == asked; }));
}

}  // namespace

int main(int argc, char** argv) { run_program("design", dispatch, argc, argv); }
