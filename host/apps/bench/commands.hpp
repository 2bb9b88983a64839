// commands.hpp - what `bench` can do; main.cpp parses, each command prints. All return an exit code.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/shared/exit_code.hpp"
#include "experiment/experiment.hpp"
#include "run/run.hpp"
#include "session/inspect_print.hpp"

namespace kreisel::core::bench {

using namespace apps;  // exit codes, checks of outputs, progress

struct OnceOptions {
  RunConfig config;
  std::string json_file, mesh_file, record_file;  ///< empty: not written; json "-" is standard output
};
int run_once(const OnceOptions& options);

struct ExperimentOptions {
  std::string name;  ///< a path, or the name of an experiment that comes with the program
  std::string results = "results/runs";
  std::string csv_file;  ///< the tables as CSV, too
  std::string models;    ///< where mesh files are that are not here; empty: see models_folder()
  std::string device;
  std::string shard;  ///< "I/N"; empty: all of it
  bool force = false, dry_run = false;
};
int run_experiment(const ExperimentOptions& options);
/// Read and looked through: unknown models, figures and published numbers are told before hours of work.
/// @throws InputError
[[nodiscard]] Experiment experiment_of(const std::string& name);

struct SubmitOptions {
  std::string name, results = "results/runs", models, device;  ///< as ExperimentOptions
  int tasks = 8;
  std::string partition, time;  ///< as Slurm takes them; empty: the cluster's own
  bool dry_run = false;         ///< prints the script
};
/// An experiment as an array job of Slurm. [docs/cluster.md]
int submit_experiment(const SubmitOptions& options);

struct WatchOptions {
  std::string name, results = "results/runs";
  double every = 5;  ///< seconds
};
/// How far it is, whoever runs it: once, or on a terminal until it is over.
int watch_experiment(const WatchOptions& options);

struct InspectOptions {
  RunConfig config;       ///< its body
  std::string json_file;  ///< empty: not written; "-" is standard output
};
/// Everything about a mesh: checks, repairs, shells; as a solid its mass properties and what it does already.
/// @throws InputError  after all that can be said was printed: why the mesh is no solid
int inspect_model(const InspectOptions& options);

struct InspectPrintOptions {
  std::string file;
  FilamentSpec filament;
  PrintQuestion question;
  std::string json_file;  ///< empty: not written; "-" is standard output
};
/// What a G-code file prints, by type and object, and what that does. [docs/printing.md]
int inspect_gcode(const InspectPrintOptions& options);

struct CompareOptions {
  std::string a, b;                  ///< folders of records, or one each
  std::optional<double> fail_above;  ///< a ratio of seconds, B / A
  std::string csv_file;              ///< empty: not written
};
/// Two folders of results, run by run. @throws InputError  no run in common, after those that are not
int compare_results(const CompareOptions& options);

struct MapOptions {
  MapRun run;
  std::string json_file, record_file;  ///< empty: not written; json "-" is standard output
};
/// Where a body can spin, or float: every orientation over one domain.
int map_model(const MapOptions& options);

struct SimulateOptions {
  std::string record;  ///< of a run; else the mesh of `config`
  RunConfig config;
  bool mesh = false, omega = false;  ///< were they given?
  SimulationSpec spec;
  std::string json_file, record_file;  ///< empty: not written; json "-" is standard output
};
/// Sets a solid and the part made of it in motion, side by side.
int simulate_part(const SimulateOptions& options);

struct NestOptions {
  std::vector<GivenText> given;              ///< fields of a nesting, as they were typed
  std::string json_file, record_file;        ///< empty: not written; json "-" is standard output
  std::string checkpoint_file, resume_file;  ///< where a search is kept, and one to go on with
};
/// Whether one shape nests in another, or up to which scale; where it nests largest; or how far sampled
/// scales are from exact ones.
int nest_shapes(const NestOptions& options);

struct ReportOptions {
  std::vector<std::string> experiments;  ///< as ExperimentOptions::name; empty: all that have records
  std::string results = "results/runs", output = "report.html";
  std::vector<std::string> markdown;  ///< files with marked places for tables; then there is no page
};
/// Tables and figures of experiments that have been run, as one HTML page.
int report(const ReportOptions& options);
/// Their tables, in the marked places of Markdown files. [docs/tables.md]
int report_markdown(const ReportOptions& options);

struct ShowOptions {
  std::vector<std::string> paths;  ///< records, or folders of them
  std::string columns;             ///< with commas between them; empty: what there is to say of a record
  std::string published;           ///< numbers for columns "published.NAME": a name or a file; may be empty
  std::string json_file;           ///< of the columns; empty: a table; "-" is standard output
};
/// Prints records, or values of columns: a row a record.
int show(const ShowOptions& options);

/// Of these records. @throws InputError  an expression that cannot be read
int show_columns(const ShowOptions& options, const std::vector<std::filesystem::path>& records);

/// The columns that have names of their own. @param markdown  as the table of docs/experiments.md
int list_columns(bool markdown);

struct FieldsOptions {
  std::string kind;       ///< empty: all
  bool markdown = false;  ///< as the table of docs/fields.md
};
/// What each kind of run can be told. @throws InputError  no such kind
int fields(const FieldsOptions& options);

/// Models, problems, formulations, solvers, experiments, and which solver works with which formulation.
int list();

/// Devices with what they say and what was measured. @param measure  false: only what they say
int devices(bool measure, const std::string& only);

}  // namespace kreisel::core::bench
