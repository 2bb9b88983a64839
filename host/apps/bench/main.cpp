// main.cpp - `bench`: argument parsing only.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <tuple>

#include "apps/bench/commands.hpp"
#include "apps/bench/nest_options.hpp"
#include "apps/bench/outputs.hpp"
#include "apps/bench/simulate_options.hpp"
#include "device/device.hpp"
#include "error.hpp"
#include "memory.hpp"
#include "nearest.hpp"
#include "run/build_info.hpp"
#include "solve/interrupt.hpp"

namespace {

using kreisel::InputError;
using namespace kreisel::bench;

/// Fields of a run that have an option of their own: name, help.
constexpr std::pair<const char*, const char*> fields[] = {
    {"model", "a name of `bench list`, or a mesh file (STL, 3MF, OBJ, PLY, OFF); default ellipsoid"},
    {"problem", "what is asked; default spin"},
    {"formulation", "how the interior is described; default rayrep"},
    {"solver", "default: ipopt, for quadric moment"},
    {"domain", "columns (whole cells) or exact (cut at the wall); default columns, for quadric exact"},
    {"resolution", "cells along the longest side, or NXxNYxNZ; default 64"},
    {"level", "of an octree: 2^level cells along the longest side"},
    {"wall", "least wall: 1.5h (cells), 2% (of the longest side) or mm; default 1.5h"},
    {"rounding", "of the written part: nearest, or fitted so that the constraints hold (default)"},
    {"part", "written (default), or none: the run ends with the solve"},
    {"axis", "spin axis x,y,z in model coordinates; default up"},
    {"contact", "a point of the axis, mm; default the lowest along it, for yoyo the centre of mass"},
    {"up", "up direction x,y,z; default the model's, else 0,0,1"},
    {"unit", "of an STL, OBJ, PLY or OFF file: mm, cm, m or in; default mm"},
    {"size", "longest side in mm; default as the model is"},
    {"density", "of the shell, g/cm^3; default 1"},
    {"interior-density", "of what is left of the interior, g/cm^3; default the shell's"},
    {"void-density", "of what fills the voids, g/cm^3; default 0"},
    {"axle", "yoyo: radius of an axle between two halves, mm; default none, the body stays whole"},
    {"slot", "yoyo: gap between the halves, mm; default the axle's radius"},
    {"axle-depth", "yoyo: of the hole for the axle in each half, mm; default twice its radius"},
    {"fineness", "of a parametric model: about 20 n^2 triangles"},
    {"device", "index or part of a name; default KREISEL_DEVICE, else a GPU, else PoCL"},
    {"precision", "automatic or single (compensated)"},
    {"repeat", "timed solves at most; default 1"},
    {"budget", "seconds after which no further repetition starts; default 20"},
};

/// Settings of problems with an option of their own: option, setting, help.
constexpr std::tuple<const char*, const char*, const char*> problem_settings[] = {
    {"target", "problem.target", "stand: centre, inside or max-tilt; default centre"},
    {"lower", "problem.lower", "top: mass, height or none, beside the inertia ratio; default mass"},
    {"draft", "problem.draft", "float: 60% of the height, mm, grams (40g) or solid; default 60%"},
    {"fluid-density", "problem.fluid_density", "float: g/cm^3; default 1"},
    {"point", "problem.point", "balance: where the centre of mass is to be, x,y,z in mm"},
    {"line", "problem.line", "balance: direction of a line through that point"},
};

struct Parsed {
  OnceOptions once;
  ExperimentOptions experiment;
  ReportOptions report;
  MapOptions map;
  SimulateOptions simulate;
  NestOptions nest;
  std::vector<std::pair<std::string, std::string>> given;  ///< field, text
  std::vector<std::string> settings, paths;
  std::string only_device;
  bool no_measure = false;
};

void add_field(CLI::App& app, Parsed& parsed, const std::string& option, const std::string& name,
               const char* help) {
  app.add_option_function<std::string>(
      option, [&parsed, name](const std::string& text) { parsed.given.emplace_back(name, text); }, help);
}

void add_run_options(CLI::App& app, Parsed& parsed) {
  for (const auto& [name, help] : fields) add_field(app, parsed, fmt::format("--{}", name), name, help);
  for (const auto& [name, setting, help] : problem_settings)
    add_field(app, parsed, fmt::format("--{}", name), setting, help);
  app.add_option("--set", parsed.settings,
                 "GROUP.NAME=VALUE; groups: ipopt (any of its options), moment, problem, formulation, solver")
      ->allow_extra_args(false)
      ->type_name("GROUP.NAME=VALUE");
  app.add_option_function<std::string>(
         "--certify",
         [&parsed](const std::string& text) {
           parsed.given.emplace_back("certify", text == "true" || text.empty() ? "1e-3" : text);
         },
         "prove how far from the best the result can be, until this relative gap; alone: 1e-3")
      ->expected(0, 1)
      ->type_name("GAP");
  app.add_option("--json", parsed.once.json_file, "write the result as JSON; - for standard output");
  app.add_option("--mesh", parsed.once.mesh_file,
                 "write the hollowed part, mm; .stl, .3mf, .obj, .ply or .off");
  app.add_option("--record", parsed.once.record_file, "write the whole run as HDF5");
}

void add_inspect_options(CLI::App& app, Parsed& parsed) {
  for (const auto& [name, help] : fields) {
    const std::string_view field = name;
    if (field == "model") add_field(app, parsed, "model,--model", name, help);
    for (const char* used : {"axis", "contact", "up", "unit", "size", "density", "fineness", "device"})
      if (field == used) add_field(app, parsed, fmt::format("--{}", name), name, help);
  }
  app.get_option("--model")->required();
  app.add_option("--json", parsed.once.json_file, "write it all as JSON; - for standard output");
}

void add_map_options(CLI::App& app, Parsed& parsed) {
  constexpr std::string_view used[] = {"model",   "resolution",       "wall",         "size",
                                       "density", "interior-density", "void-density", "fineness",
                                       "device",  "precision"};
  for (const auto& [name, help] : fields)
    if (std::ranges::find(used, std::string_view(name)) != std::end(used))
      add_field(app, parsed, name == std::string_view("model") ? "model,--model" : fmt::format("--{}", name),
                name, help);
  app.get_option("--model")->required();
  add_field(app, parsed, "--problem", "problem", "spin (default) or float");
  add_field(app, parsed, "--up", "up",
            "along which the rays of the one domain run; default the model's axis");
  add_field(app, parsed, "--fluid-density", "problem.fluid_density", "float: g/cm^3; default 1");
  app.add_option("--set", parsed.settings, "GROUP.NAME=VALUE; groups: problem, solver")
      ->allow_extra_args(false)
      ->type_name("GROUP.NAME=VALUE");
  add_field(app, parsed, "--axes", "axes", "directions of the sphere; default 2000");
  add_field(app, parsed, "--through", "through",
            "axes run through the lowest point (default), or the solid's centre of mass");
  add_field(app, parsed, "--drafts", "drafts", "float: of the height, mm or grams; default 20%,40%,60%,80%");
  app.add_option("--json", parsed.map.json_file, "write it all as JSON; - for standard output");
  app.add_option("--record", parsed.map.record_file, "write the map as HDF5");
}

void add_nest_options(CLI::App& app, NestOptions& nest) {
  add_nest_fields(app, nest.given);
  app.add_option("--json", nest.json_file, "write the answer as JSON; - for standard output");
  app.add_option("--record", nest.record_file, "write the whole run as HDF5");
  app.add_option("--checkpoint", nest.checkpoint_file,
                 "keep the search there, every half a minute and when it is stopped");
  app.add_option("--resume", nest.resume_file,
                 "go on with a checkpoint, by the options that it was begun with; it is kept there again");
}

void apply(Parsed& parsed) {
  for (const auto& [field, text] : parsed.given) set_field(parsed.once.config, field, text);
  for (const std::string& setting : parsed.settings) {
    const auto equals = setting.find('=');
    const auto dot = setting.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot > equals)
      throw InputError(fmt::format("--set {}; expected GROUP.NAME=VALUE", setting));
    set_field(parsed.once.config, setting.substr(0, equals), setting.substr(equals + 1));
  }
}

/// One line for what CLI11 refuses: of an unknown option or command its name and the nearest that there is.
std::string explained(const CLI::App& app, const CLI::ParseError& error) {
  constexpr const char* help = "(bench --help lists the options)";
  const CLI::App* used = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  std::vector<std::string> extras;
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) extras = used->remaining(true);
  if (extras.empty()) return fmt::format("{} {}", error.what(), help);
  // What follows an unknown option is unknown, too: the option is the one to name.
  const auto option = std::ranges::find_if(extras, [](const std::string& e) { return e.starts_with('-'); });
  const std::string& extra = option != extras.end() ? *option : extras.front();
  std::vector<std::string> names;
  for (const CLI::Option* known : used->get_options()) names.push_back(known->get_name());
  for (const CLI::App* sub : used->get_subcommands(nullptr)) names.push_back(sub->get_name());
  const std::string meant = kreisel::nearest(extra.substr(0, extra.find('=')), names);
  return fmt::format("'{}' was not expected{}; expected an option or a command {}", extra,
                     meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant), help);
}

int dispatch(int argc, char** argv) {
  CLI::App app("Kreisel: where must material go inside a shape so that it spins, stands or floats?", "bench");
  app.set_version_flag(
      "--version", fmt::format("kreisel {} ({})", kreisel::build_info::version, kreisel::build_info::commit));
  app.require_subcommand(0, 1);
  Parsed parsed;
  add_run_options(app, parsed);

  CLI::App* experiment =
      app.add_subcommand("run", "run an experiment (TOML) and print its table; finished runs are skipped");
  experiment->add_option("experiment", parsed.experiment.name, "a file, or the name of one of `bench list`")
      ->required();
  experiment->add_option("--results", parsed.experiment.results, "folder of the records")
      ->capture_default_str();
  experiment->add_option("--csv", parsed.experiment.csv_file, "write the table as CSV, too");
  experiment->add_option("--device", parsed.experiment.device, "as above, for every run");
  experiment->add_flag("--force", parsed.experiment.force, "run finished runs again");
  experiment->add_flag("--dry-run", parsed.experiment.dry_run, "say what would run");
  CLI::App* inspected = app.add_subcommand(
      "inspect", "check a mesh: faults, repairs, shells, mass properties, and what it does as a solid");
  add_inspect_options(*inspected, parsed);
  CLI::App* mapped = app.add_subcommand(
      "map", "every orientation over one domain: about which axes can a body spin, or float");
  add_map_options(*mapped, parsed);
  CLI::App* simulated = app.add_subcommand(
      "simulate", "set a part and the solid it was made of in motion: what does physics say?");
  add_simulate_options(*simulated, parsed.simulate, [&](const std::string& field, const std::string& text) {
    parsed.given.emplace_back(field, text);
  });
  for (const auto& [name, help] : fields)
    for (const char* used : {"axis", "up", "unit", "size", "density", "void-density", "fineness", "device"})
      if (name == std::string_view(used))
        add_field(*simulated, parsed, fmt::format("--{}", name), name, help);
  simulated->add_option("--set", parsed.settings, "problem.NAME=VALUE")->allow_extra_args(false);
  CLI::App* nested = app.add_subcommand(
      "nest", "does one shape fit into another, to be taken out through a cut, and how large");
  add_nest_options(*nested, parsed.nest);
  CLI::App* reported =
      app.add_subcommand("report", "tables and figures of experiments that have been run, as one HTML page");
  reported->add_option("experiments", parsed.report.experiments, "default: all that have records");
  reported->add_option("--results", parsed.report.results, "folder of the records")->capture_default_str();
  reported->add_option("-o,--output", parsed.report.output, "the page")->capture_default_str();
  CLI::App* shown = app.add_subcommand("show", "print records");
  shown->add_option("records", parsed.paths, "HDF5 files, or folders of them")->required();
  CLI::App* listed =
      app.add_subcommand("list", "models, problems, formulations, solvers, experiments; which pairs work");
  CLI::App* probed = app.add_subcommand("devices", "OpenCL devices, with measured bandwidth and flop rate");
  probed->add_flag("--no-measure", parsed.no_measure, "only what they say of themselves");
  probed->add_option("--device", parsed.only_device, "only this one");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    throw InputError(explained(app, error));
  }
  if (*experiment) return run_experiment(parsed.experiment);
  if (*inspected) {
    apply(parsed);
    return inspect_model({parsed.once.config, parsed.once.json_file});
  }
  if (*mapped) {
    apply(parsed);
    parsed.map.config = parsed.once.config;
    return map_model(parsed.map);
  }
  if (*simulated) {
    apply(parsed);
    parsed.simulate.config = parsed.once.config;
    return simulate_part(parsed.simulate);
  }
  if (*nested) return nest_shapes(parsed.nest);
  if (*reported) return report(parsed.report);
  if (*shown) return show(parsed.paths);
  if (*listed) return list();
  if (*probed) return devices(!parsed.no_measure, parsed.only_device);
  if (argc == 1) {
    fmt::print("{}", app.help());
    return done;
  }
  apply(parsed);
  return run_once(parsed.once);
}

/// Prints the one line of an error. @return  the code
int say(std::string_view what, int code) {
  std::fflush(stdout);
  fmt::print(stderr, "bench: {}\n", what);
  return code;
}

int say_memory_ran_out() {
  const kreisel::Memory memory = kreisel::available_memory();
  return say(
      fmt::format("not enough memory, {} {:.2g} GiB; expected more, a coarser --resolution or a mesh of "
                  "fewer triangles",
                  memory.of, memory.bytes / (1 << 30)),
      not_converged);
}

int run(int argc, char** argv) {
  try {
    const int code = dispatch(argc, argv);
    flush_output();
    return code;
  } catch (const InputError& error) {
    return say(error.what(), bad_input);
  } catch (const kreisel::Interrupted&) {
    return say("interrupted, nothing written", was_interrupted);
  } catch (const kreisel::MemoryError& error) {
    return say(error.what(), not_converged);
  } catch (const std::bad_alloc&) {
    return say_memory_ran_out();
  } catch (const std::exception& error) {
    return say(fmt::format("internal error: {}", error.what()), 1);
  }
}

/// What a library's thread throws reaches no catch of ours.
[[noreturn]] void on_terminate() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    std::_Exit(say_memory_ran_out());
  } catch (const std::exception& error) {
    std::_Exit(say(fmt::format("internal error: {}", error.what()), 1));
  } catch (...) {
  }
  std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  kreisel::catch_interrupts();
  std::set_terminate(on_terminate);
  // A file that may not grow fails as on a full disk: the write says so and what is begun is removed.
  std::signal(SIGXFSZ, SIG_IGN);
  const int code = run(argc, argv);
  std::fflush(stdout);
  // Without the goodbyes of libraries: OpenBLAS' waits for its threads, which, where memory is short, wait
  // for memory.
  std::_Exit(code);
}
