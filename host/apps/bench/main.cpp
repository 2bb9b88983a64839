// main.cpp - `bench`: argument parsing only.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/bench/commands.hpp"
#include "apps/bench/simulate_options.hpp"
#include "apps/shared/completion.hpp"
#include "apps/shared/manual.hpp"
#include "apps/shared/outputs.hpp"
#include "apps/shared/program.hpp"
#include "apps/shared/run_options.hpp"
#include "error.hpp"
#include "experiment/experiment.hpp"
#include "session/build_info.hpp"
#include "table/columns.hpp"

namespace {

using kreisel::core::experiment_names;
using kreisel::core::find_run_kind;
using kreisel::core::InputError;
using kreisel::core::RunKind;
using namespace kreisel::core::bench;

struct Parsed {
  OnceOptions once;
  ExperimentOptions experiment;
  SubmitOptions submit;
  WatchOptions watch;
  ReportOptions report;
  CompareOptions compare;
  MapOptions map;
  SimulateOptions simulate;
  NestOptions nest;
  FieldsOptions fields;
  RunOptions run;
  ShowOptions show;
  std::optional<double> filament_diameter;
  std::string only_device;
  bool no_measure = false, markdown = false, by_slurm = false;
};

void add_file(CLI::App& app, const char* name, std::string& file, const char* help) {
  app.add_option(name, file, help)->type_name("FILE")->group("Output");
}

void add_run_options(CLI::App& app, Parsed& parsed) {
  const RunKind& solve = find_run_kind("solve");
  // A process of its own is what experiments make of a run with limits.
  parsed.run.add_but(app, {&solve}, {"memory", "seconds"});
  parsed.run.add_settings(app, solve);
  add_file(app, "--json", parsed.once.json_file, "write the result as JSON; - writes it to standard output");
  add_file(app, "--mesh", parsed.once.mesh_file,
           "write the hollowed part in mm: .stl, .3mf, .obj, .ply or .off");
  add_file(app, "--record", parsed.once.record_file, "write the whole run as HDF5");
}

void add_inspect_options(CLI::App& app, Parsed& parsed) {
  parsed.run.add_model(app);
  parsed.run.add_some(app, {&find_run_kind("solve")},
                      {"axis", "contact", "up", "unit", "weld", "close-holes", "inside-out", "pieces", "size",
                       "density", "fineness"});
  parsed.run.add(app, "--problem", "problem",
                 "G-code: the problem that judges it; default: all that go by moments alone");
  parsed.run.add_settings(app, find_run_kind("solve"));
  app.add_option("--filament", parsed.filament_diameter,
                 "G-code: diameter of the filament in mm; default: as the file says, else 1.75")
      ->check(CLI::Range(0.1, 10.0));
  add_file(app, "--json", parsed.once.json_file, "write it all as JSON; - writes it to standard output");
}

/// @throws InputError  what is said of the mesh alone
InspectPrintOptions print_options(const Parsed& parsed) {
  const kreisel::core::RunConfig& config = parsed.once.config;
  InspectPrintOptions options;
  options.file = config.body.model;
  options.json_file = parsed.once.json_file;
  options.filament.diameter = parsed.filament_diameter;
  for (const auto& given : parsed.run.given()) {
    const std::string& key = given.name;
    if (key == "density") options.filament.density = config.body.density;
    if (key == "problem") options.question.problem = config.problem;
    for (const char* of_mesh :
         {"up", "unit", "weld", "close-holes", "inside-out", "pieces", "size", "fineness"})
      if (key == of_mesh)
        throw InputError(
            fmt::format("--{} of G-code, which is no mesh; expected --axis, --contact, --density, "
                        "--filament or --problem",
                        key));
  }
  options.question.settings = kreisel::core::settings_of(config, "problem");
  options.question.axis = config.body.axis;
  options.question.contact = config.body.contact;
  return options;
}

void add_map_options(CLI::App& app, Parsed& parsed) {
  const RunKind& map = find_run_kind("map");
  parsed.run.add_model(app);
  parsed.run.add_but(app, {&map}, {"model"});
  parsed.run.add_settings(app, map);
  add_file(app, "--json", parsed.map.json_file, "write it all as JSON; - writes it to standard output");
  add_file(app, "--record", parsed.map.record_file, "write the map as HDF5");
}

void add_nest_options(CLI::App& app, Parsed& parsed) {
  NestOptions& nest = parsed.nest;
  parsed.run.add(app, nesting_kinds());
  add_file(app, "--json", nest.json_file, "write the answer as JSON; - writes it to standard output");
  add_file(app, "--record", nest.record_file, "write the whole run as HDF5");
  add_file(app, "--checkpoint", nest.checkpoint_file,
           "keep the search there, every half a minute and when it is stopped");
  add_file(app, "--resume", nest.resume_file,
           "go on with a checkpoint, by the options that it was begun with; it is kept there again");
}

/// A subcommand, and what it does once all is parsed.
using Command = std::pair<CLI::App*, std::function<int()>>;

Command add_experiment(CLI::App& app, Parsed& parsed) {
  CLI::App* experiment = app.add_subcommand(
      "run", "make the runs of an experiment (TOML) and print its table; finished runs are skipped");
  offer(experiment
            ->add_option("experiment", parsed.experiment.name, "a file, or the name of one of `bench list`")
            ->type_name("NAME|FILE")
            ->required(),
        experiment_names);
  experiment->add_option("--results", parsed.experiment.results, "folder of the records")
      ->type_name("FOLDER")
      ->capture_default_str();
  add_file(*experiment, "--csv", parsed.experiment.csv_file, "also write the table as CSV");
  experiment
      ->add_option(
          "--models", parsed.experiment.models,
          "folder of mesh files that are not in the current one; default: KREISEL_MODELS, else models")
      ->type_name("FOLDER");
  experiment->add_option("--device", parsed.experiment.device,
                         "OpenCL device for every run: its index, or part of its name");
  experiment
      ->add_option("--shard", parsed.experiment.shard,
                   "make only the I-th of N shares of the runs; the shares are about equal in work")
      ->type_name("I/N");
  experiment->add_flag("--force", parsed.experiment.force, "make finished runs again");
  experiment->add_flag("--dry-run", parsed.experiment.dry_run, "only say what would run");
  experiment->footer(
      "Examples:\n"
      "  bench run rayrep_table2 --dry-run          what would run\n"
      "  bench run rayrep_table2 --csv table.csv    run it, print its table, and write that");
  return {experiment, [&parsed] { return run_experiment(parsed.experiment); }};
}

Command add_submit(CLI::App& app, Parsed& parsed) {
  SubmitOptions& options = parsed.submit;
  CLI::App* submitted = app.add_subcommand("submit", "make them on a cluster, as an array job of Slurm");
  offer(submitted->add_option("experiment", options.name, "a file, or the name of one of `bench list`")
            ->type_name("NAME|FILE")
            ->required(),
        experiment_names);
  // There is one engine; naming it leaves room for another.
  submitted->add_flag("--slurm", parsed.by_slurm, "by Slurm's sbatch")->required();
  submitted->add_option("--tasks", options.tasks, "shards, each a task on one core")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  submitted->add_option("--partition", options.partition, "default: the cluster's")->type_name("NAME");
  submitted->add_option("--time", options.time, "limit of a task; default: the partition's")
      ->type_name("D-H:M:S");
  submitted->add_option("--results", options.results, "folder of the records, seen by all nodes")
      ->type_name("FOLDER")
      ->capture_default_str();
  submitted->add_option("--models", options.models, "as of `bench run`")->type_name("FOLDER");
  submitted->add_option("--device", options.device, "as of `bench run`");
  submitted->add_flag("--dry-run", options.dry_run, "print the job's script");
  submitted->footer("Example:\n  bench submit rayrep_table2 --slurm --tasks 8 --time 1:00:00");
  return {submitted, [&parsed] { return submit_experiment(parsed.submit); }};
}

Command add_watch(CLI::App& app, Parsed& parsed) {
  WatchOptions& options = parsed.watch;
  CLI::App* watched =
      app.add_subcommand("watch", "say how far an experiment is, from its records, whoever runs it");
  offer(watched->add_option("experiment", options.name, "a file, or the name of one of `bench list`")
            ->type_name("NAME|FILE")
            ->required(),
        experiment_names);
  watched->add_option("--results", options.results, "folder of the records")
      ->type_name("FOLDER")
      ->capture_default_str();
  watched->add_option("--every", options.every, "seconds between looks, on a terminal")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  watched->footer("Example:\n  bench watch rayrep_table2 --every 10");
  return {watched, [&parsed] { return watch_experiment(parsed.watch); }};
}

/// @throws InputError  what is said of G-code alone
void require_of_mesh(const Parsed& parsed) {
  const auto given = parsed.run.given();
  const bool asked = std::ranges::any_of(
      given, [](const auto& one) { return one.name == "problem" || kreisel::core::is_setting(one.name); });
  if (asked || parsed.filament_diameter)
    throw InputError(fmt::format(
        "{}: --problem, --set and --filament are for G-code (.gcode); a mesh is judged by every problem",
        parsed.once.config.body.model));
}

Command add_inspect(CLI::App& app, Parsed& parsed) {
  CLI::App* inspected = app.add_subcommand(
      "inspect", "check and weigh a mesh, and say what it does as a solid; or weigh what G-code prints");
  add_inspect_options(*inspected, parsed);
  inspected->footer(
      "Examples:\n"
      "  bench inspect top.stl --axis 0,0,1              does the solid spin about z?\n"
      "  bench inspect scan.ply --close-holes 2          what it is with its holes closed\n"
      "  bench inspect part.gcode --density 1.24         what a print of PLA weighs");
  return {inspected, [&parsed] {
            parsed.run.apply(parsed.once.config);
            if (kreisel::core::is_gcode(parsed.once.config.body.model))
              return inspect_gcode(print_options(parsed));
            require_of_mesh(parsed);
            return inspect_model({parsed.once.config, parsed.once.json_file});
          }};
}

Command add_map(CLI::App& app, Parsed& parsed) {
  CLI::App* mapped =
      app.add_subcommand("map", "try every orientation: about which axes can a body spin, or float?");
  add_map_options(*mapped, parsed);
  mapped->footer(
      "Examples:\n"
      "  bench map bunny --axes 500 --wall 2%            about which axes can it spin?\n"
      "  bench map duck --problem float --record m.h5    which way up can it float, and how deep?");
  return {mapped, [&parsed] {
            parsed.map.run = std::get<kreisel::core::MapRun>(parsed.run.make(find_run_kind("map")));
            return map_model(parsed.map);
          }};
}

Command add_simulate(CLI::App& app, Parsed& parsed) {
  CLI::App* simulated =
      app.add_subcommand("simulate", "set a part and its solid in motion, and say which speeds are stable");
  add_simulate_options(*simulated, parsed.simulate, [&](const std::string& field, const std::string& text) {
    parsed.run.say(field, text);
  });
  parsed.run.add_some(*simulated, {&find_run_kind("simulation")},
                      {"axis", "up", "unit", "weld", "close-holes", "inside-out", "pieces", "size", "density",
                       "void-density", "fineness", "device", "problem.fluid_density"});
  parsed.run.add_settings(*simulated, find_run_kind("simulation"));
  simulated->footer(
      "Examples:\n"
      "  bench simulate run.h5 --scan --record motion.h5       a run that bench --record wrote\n"
      "  bench simulate --mesh part.stl --contact 27.05,19.5,0  a file, on its tip");
  return {simulated, [&parsed] {
            parsed.run.apply(parsed.once.config);
            parsed.simulate.config = parsed.once.config;
            return simulate_part(parsed.simulate);
          }};
}

Command add_nest(CLI::App& app, Parsed& parsed) {
  CLI::App* nested = app.add_subcommand(
      "nest", "does one shape fit into another, to be taken out through a cut, and how large?");
  add_nest_options(*nested, parsed);
  nested->footer(
      "Examples:\n"
      "  bench nest --outer bunny --plane 0,1,0                 the largest scale at one placement\n"
      "  bench nest --outer bunny --scale 0.3 --plane 0,1,0     does this scale nest?\n"
      "  bench nest --outer heart --inner duck --free all       where does it nest largest?");
  return {nested, [&parsed] {
            parsed.nest.given = parsed.run.given();
            return nest_shapes(parsed.nest);
          }};
}

Command add_report(CLI::App& app, Parsed& parsed) {
  CLI::App* reported =
      app.add_subcommand("report", "write tables and figures of experiments as one HTML page");
  offer(reported->add_option("experiments", parsed.report.experiments, "default: all that have records"),
        experiment_names);
  reported->add_option("--results", parsed.report.results, "folder of the records")
      ->type_name("FOLDER")
      ->capture_default_str();
  reported->add_option("-o,--output", parsed.report.output, "the page")
      ->type_name("FILE")
      ->capture_default_str();
  reported
      ->add_option("--markdown", parsed.report.markdown,
                   "no page: write the tables into the marked places of these files")
      ->type_name("FILE ...");
  reported->footer("Example:\n  bench report rayrep_table2 -o report.html");
  return {reported, [&parsed] {
            return parsed.report.markdown.empty() ? report(parsed.report) : report_markdown(parsed.report);
          }};
}

Command add_show(CLI::App& app, Parsed& parsed) {
  ShowOptions& options = parsed.show;
  CLI::App* shown = app.add_subcommand("show", "print records, or values of columns");
  shown->add_option("records", options.paths, "HDF5 files, or folders of them")
      ->type_name("FILE|FOLDER")
      ->required();
  offer(shown
            ->add_option("--columns", options.columns,
                         "a row a record: names of `bench columns`, of a record's JSON, or arithmetic with "
                         "them, with commas between them")
            ->type_name("NAME,..."),
        kreisel::core::names_in(kreisel::core::columns));
  shown
      ->add_option("--published", options.published,
                   "numbers for columns published.NAME: a name of results/published, or a file")
      ->type_name("NAME|FILE");
  add_file(*shown, "--json", options.json_file, "write the columns as JSON; - writes it to standard output");
  shown->footer("Example:\n  bench show results/runs/rayrep_table2 --columns model,seconds,objective");
  return {shown, [&parsed] { return show(parsed.show); }};
}

Command add_columns(CLI::App& app, Parsed& parsed) {
  CLI::App* listed = app.add_subcommand("columns", "list the columns of tables, CSV and figures");
  listed->add_flag("--markdown", parsed.markdown, "print a Markdown table");
  return {listed, [&parsed] { return list_columns(parsed.markdown); }};
}

Command add_compare(CLI::App& app, Parsed& parsed) {
  CLI::App* compared = app.add_subcommand(
      "compare", "compare two folders of records: ratios of time, differences of objective");
  compared->add_option("A", parsed.compare.a, "records of one commit, machine or setting")
      ->type_name("FOLDER")
      ->required();
  compared->add_option("B", parsed.compare.b, "the same runs of another")->type_name("FOLDER")->required();
  compared->add_option("--fail-above", parsed.compare.fail_above,
                       "exit code 1 where a run of B takes more than so many times as long");
  add_file(*compared, "--csv", parsed.compare.csv_file, "also write the table as CSV");
  compared->footer("Example:\n  bench compare results/before results/after --fail-above 1.2");
  return {compared, [&parsed] { return compare_results(parsed.compare); }};
}

Command add_fields(CLI::App& app, Parsed& parsed) {
  CLI::App* listed =
      app.add_subcommand("fields", "list the kinds of runs, and the fields of each: options, TOML keys");
  offer(listed->add_option("kind", parsed.fields.kind,
                           "solve, map, simulation, or a nesting: scale, test, swarm, ..."),
        kreisel::core::names_in(kreisel::core::run_kinds));
  listed->add_flag("--markdown", parsed.fields.markdown, "print a Markdown table");
  listed->footer("Example:\n  bench fields swarm");
  return {listed, [&parsed] { return fields(parsed.fields); }};
}

Command add_devices(CLI::App& app, Parsed& parsed) {
  CLI::App* probed =
      app.add_subcommand("devices", "list OpenCL devices, and measure their bandwidth and flop rate");
  probed->add_flag("--no-measure", parsed.no_measure, "print only what the devices say of themselves");
  probed->add_option("--device", parsed.only_device, "measure this device alone");
  return {probed, [&parsed] { return devices(!parsed.no_measure, parsed.only_device); }};
}

int dispatch(int argc, char** argv) {
  CLI::App app("Kreisel: where must material go inside a shape so that it spins, stands or floats?", "bench");
  app.set_version_flag("--version", fmt::format("kreisel {} ({})", kreisel::core::build_info::version,
                                                kreisel::core::build_info::commit));
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n"
      "  bench --model bunny --problem stand --mesh part.stl     solve, and write the part\n"
      "  bench --formulation quadric --certify                   prove how good the result is\n"
      "  bench inspect part.stl                                  what a mesh weighs and does\n"
      "  bench run rayrep_table2                                 make a table of a paper\n"
      "`bench COMMAND --help` says more of a command.");
  Parsed parsed;
  add_run_options(app, parsed);
  std::vector<Command> commands;
  for (const auto add : {add_experiment, add_submit, add_watch, add_inspect, add_map, add_simulate, add_nest,
                         add_report, add_show, add_compare, add_columns, add_fields})
    commands.push_back(add(app, parsed));
  commands.emplace_back(
      app.add_subcommand("list", "list models, problems, formulations, solvers, experiments"), list);
  commands.push_back(add_devices(app, parsed));
  commands.emplace_back(add_completion(app), [] { return done; });
  if (completes(app, argc, argv) || prints_manual(app, argc, argv)) return done;
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    throw InputError(explained(app, error));
  }
  for (const auto& [command, work] : commands)
    if (*command) return work();
  if (argc == 1) {
    fmt::print("{}", app.help());
    return done;
  }
  parsed.run.apply(parsed.once.config);
  return run_once(parsed.once);
}

}  // namespace

int main(int argc, char** argv) { kreisel::core::apps::run_program("bench", dispatch, argc, argv); }
