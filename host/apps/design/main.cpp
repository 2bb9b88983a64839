// main.cpp - `design`: argument parsing only.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "apps/design/live.hpp"
#include "apps/design/nest.hpp"
#include "apps/design/outputs.hpp"
#include "apps/design/print.hpp"
#include "apps/shared/completion.hpp"
#include "apps/shared/exit_code.hpp"
#include "apps/shared/manual.hpp"
#include "apps/shared/program.hpp"
#include "apps/shared/run_options.hpp"
#include "apps/shared/step_line.hpp"
#include "design/page.hpp"
#include "error.hpp"
#include "file/write_text.hpp"
#include "parse.hpp"
#include "print/printer/printer.hpp"
#include "problem/problem.hpp"
#include "session/build_info.hpp"
#include "session/made_fields.hpp"

namespace {

using kreisel::core::InputError;
using kreisel::core::ProblemEntry;
using kreisel::core::RunKind;
using namespace kreisel::core::apps;

struct Parsed {
  RunOptions run;
  kreisel::core::DesignSpec spec;
  DesignOutputs outputs;
  bool accept = false;
  NestArguments nest;
  LiveArguments live;
};

/// @throws InputError  not "x,y,z", or zero
kreisel::core::Vec3 direction(const char* option, const std::string& text) {
  const auto given = kreisel::core::parse_vector(text);
  if (!given || !(given->norm() > 0))
    throw InputError(fmt::format("{} {}, expected a direction X,Y,Z", option, text));
  return *given;
}

void add_print_options(CLI::App& app, Parsed& parsed) {
  kreisel::core::PrintSpec& print = parsed.spec.print;
  app.add_option("--slicer", print.slicing.slicer,
                 "slice the part and say what is printed; by prusa-slicer, cura-engine, or a command with "
                 "{model} and {gcode} in it")
      ->type_name("NAME|COMMAND");
  app.add_option("--profile", print.slicing.profile,
                 "settings of the slicer, key = value; default: layers of 0.2 mm, a nozzle of 0.4 mm, two "
                 "perimeters, filled, supports from the bed")
      ->type_name("FILE");
  app.add_option_function<std::string>(
         "--print-up",
         [&print](const std::string& text) {
           print.find_up = text == "auto";
           if (!print.find_up) print.up = direction("--print-up", text);
         },
         "which way is up while it is printed: auto (least support in voids), or a direction; default: as it "
         "stands, or along its axis")
      ->type_name("auto|X,Y,Z");
  app.add_option("--gcode", parsed.outputs.gcode, "write the G-code that the slicer makes")
      ->type_name("FILE");
  app.add_option_function<std::string>(
         "--balance", [&print](const std::string&) { print.balance = true; },
         "print: move the cut of the voids until what is printed does what was asked, not only the mesh")
      ->check(CLI::IsMember({"print"}));
  CLI::Option* infill =
      app.add_option_function<std::string>(
             "--infill",
             [&print](const std::string& text) { print.slicing.infill = kreisel::core::parse_infill(text); },
             "print sparse infill in place of voids: its share, and :pattern (default gyroid); -o is one "
             "3MF, ready for --slicer (default prusa-slicer)")
          ->type_name("N%[:PATTERN]");
  app.add_option_function<std::string>(
         "--project",
         [&print](const std::string& text) { print.slicing.dialect = kreisel::core::parse_dialect(text); },
         "which program is to open that 3MF: prusa (default), or orca (OrcaSlicer, Bambu Studio)")
      ->type_name("prusa|orca")
      ->needs(infill);
  app.add_option_function<std::string>(
         "--printer",
         [&print](const std::string& name) { print.slicing.printer = kreisel::core::find_printer(name); },
         "the printer: a part too large for its bed, or too thin for its nozzle, is refused; `design "
         "--printer list` names those that are known")
      ->type_name("NAME[@NOZZLE]");
  app.add_option("--slicer-seconds", print.slicing.seconds, "longest that the slicer may take, seconds")
      ->check(CLI::Range(1.0, 86400.0))
      ->capture_default_str();
}

/// What says how a part is sliced needs somebody who slices it. @throws InputError  nobody does
void require_slicer(const CLI::App& app) {
  if (app.count("--slicer") + app.count("--infill") > 0) return;
  for (const char* option : {"--profile", "--print-up", "--gcode", "--balance", "--slicer-seconds"})
    if (app.count(option) > 0)
      throw InputError(fmt::format("{} without a slicer, expected --slicer, too (or --infill)", option));
}

/// How it is called, and where the pose may be found, how that is asked for.
std::string examples_of(const ProblemEntry& problem) {
  std::string text = fmt::format(
      "Examples:\n"
      "  design {0} model.stl -o part.3mf --html part.html     the part, and a page to look at it\n"
      "  design {0} model.stl -o part.stl --cut auto --pegs 1  halves that pins align\n",
      problem.name);
  if (problem.poses != kreisel::core::Poses::none)
    text += fmt::format("  design {} model.stl -o part.stl --{} auto            the best pose is found\n",
                        problem.name, problem.upright ? "up" : "axis");
  return text + "Lengths are mm, masses g, densities g/cm^3.";
}

void add_options(CLI::App& app, Parsed& parsed, const ProblemEntry& problem) {
  RunOptions& run = parsed.run;
  const RunKind& solve = kreisel::core::find_run_kind("solve");
  run.add_model(app);
  parsed.outputs.add(app, "the part");
  const std::vector<std::string> settings = kreisel::core::made_settings(problem);
  std::vector<std::string_view> own = kreisel::core::made_shape(problem);
  const bool stemmed = std::ranges::find(own, "stem") != own.end();
  own.insert(own.end(), settings.begin(), settings.end());
  run.add_some(app, {&solve}, own);
  if (stemmed)
    run.add(app, "--through", "axis-through",
            "where an axis that is to be found runs: lowest (through the lowest point along it) or centre "
            "(through the centre of mass, on a stem); default: lowest, else centre");
  run.add(app, "--wall", "wall",
          "least thickness of the wall: in mm, in per cent of the longest side (2%, the default), or in "
          "cells (1.5h)");
  run.add_some(app, {&solve},
               {"unit", "weld", "close-holes", "inside-out", "pieces", "size", "density", "interior-density",
                "void-density", "fineness", "device", "deform", "keep"});
  run.add(app, "--resolution", "resolution", "cells along the longest side; default 128");
  run.add(app, "--formulation", "formulation", "how the interior is described; default quadric");
  run.add_settings(app, solve);
  app.option_defaults()->group("The part");
  app.add_option("--printer-accuracy", parsed.spec.printer_accuracy,
                 "how fine the printer prints, mm: a thinner wall is refused, and a void smaller than the "
                 "cube of five times this stays filled")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--tolerance", parsed.spec.tolerance,
                 "how far the surface of voids may be off to spare triangles, mm, never into the wall; "
                 "default: a tenth of --printer-accuracy; 0 keeps all triangles")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--cut", parsed.spec.cut,
                 "cut the part: auto (by the planes that open its voids), or by the plane N . x = D, given "
                 "as NX,NY,NZ,D in mm");
  app.add_flag("--lay-flat", parsed.spec.lay_flat,
               "lay the pieces of a cut beside each other, each on its cut");
  app.add_option("--pegs", parsed.spec.peg_radius,
                 "radius of two loose pins that align the halves of a cut, mm; default: none")
      ->check(CLI::PositiveNumber);
  app.add_flag("--mould", parsed.spec.mould,
               "also write moulds for what is denser than the shell: two halves, sprue, vents, pins");
  app.add_option("--drain", parsed.spec.drain_radius,
                 "radius of a hole from every void to the outside, mm; default: none")
      ->check(CLI::PositiveNumber);
  app.add_flag("--accept", parsed.accept,
               "end with exit code 0, even if the part does not do what was asked");
  app.option_defaults()->group("Printing");
  add_print_options(app, parsed);
  app.add_option(
         "--measured-mass", parsed.spec.measured_mass,
         "what the printed part weighs that this made before, g: the density follows, and it is solved again")
      ->check(CLI::PositiveNumber);
  app.footer(examples_of(problem));
}

int make(Parsed& parsed, const CLI::App& app, const ProblemEntry& problem) {
  require_slicer(app);
  kreisel::core::RunConfig& config = parsed.spec.config;
  config.problem = problem.name;
  config.formulation = "quadric";
  config.grid.resolution = 128;
  config.wall = kreisel::core::parse_wall("2%");
  for (const auto& [name, text] : problem.made.settings) config.settings["problem." + name] = text;
  parsed.run.apply(config);
  const DesignOutputs& outputs = parsed.outputs;
  outputs.require_writable();
  const std::string three = outputs.html.empty() ? "" : kreisel::core::installed_three();
  parsed.spec.file = outputs.part;
  kreisel::core::SliceSpec& slicing = parsed.spec.print.slicing;
  if (slicing.infill && slicing.slicer.empty()) slicing.slicer = "prusa-slicer";
  parsed.spec.gcode = outputs.gcode;
  const kreisel::core::Design design = [&] {
    const StepLine line;
    kreisel::core::Session session;
    return make_design(session, parsed.spec, line.control());
  }();
  if (!outputs.html.empty() && design.feasible())
    kreisel::core::write_text(outputs.html, page_of(design, three));
  if (outputs.write_report(to_json(design))) print_design(design);
  const bool misses = design.feasible() && !design.does() && !parsed.accept;
  const int ending = exit_code(design.run.outcome.termination);
  return ending == done && misses ? not_as_asked : ending;
}

int dispatch(int argc, char** argv) {
  CLI::App app("Kreisel: a mesh in, a printable part out that spins, stands, floats or nests", "design");
  app.set_version_flag("--version", fmt::format("kreisel {} ({})", kreisel::core::build_info::version,
                                                kreisel::core::build_info::commit));
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n"
      "  design spin top.stl -o part.3mf --axis auto          a top, about the best axis\n"
      "  design stand dragon.stl -o part.stl --up 0,1,0       it stands as hard to topple as can be\n"
      "  design float duck.obj -o part.stl --draft 55%        it floats upright, 55 % under water\n"
      "  design nest bunny.stl -o doll.3mf --layers 2         a nested doll\n"
      "`design COMMAND --help` says more of a command; `bench inspect FILE` looks at a mesh first.");
  std::string listed;
  app.add_option("--printer", listed, "list: the printers that are known, with beds, nozzles and layers")
      ->check(CLI::IsMember({"list"}));
  Parsed parsed;
  for (const ProblemEntry& problem : kreisel::core::problems())
    add_options(
        *app.add_subcommand(problem.name, problem.made.help.empty() ? problem.summary : problem.made.help),
        parsed, problem);
  CLI::App* nested =
      app.add_subcommand("nest", "a nested doll: halves that come apart, around shapes as large as fit");
  add_nest_options(*nested, parsed.nest);
  CLI::App* live = app.add_subcommand(
      "live", "a page in the browser on which all of this is dragged, served by this program");
  add_live_options(*live, parsed.live);
  const CLI::App* completion = add_completion(app);
  if (completes(app, argc, argv) || prints_manual(app, argc, argv)) return done;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    throw InputError(explained(app, error));
  }
  if (!listed.empty()) {
    print_printers();
    return done;
  }
  if (app.get_subcommands().empty()) {
    fmt::print("{}", app.help());
    return done;
  }
  if (*completion) return done;
  if (*live) return serve_page(*live, parsed.live);
  if (*nested) return nest_parts(parsed.nest);
  const CLI::App& asked = *app.get_subcommands().front();
  return make(parsed, asked, kreisel::core::find_problem(asked.get_name()));
}

}  // namespace

int main(int argc, char** argv) { run_program("design", dispatch, argc, argv); }
