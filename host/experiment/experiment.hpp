// experiment.hpp - a table or figure as data: which runs, and how to print them.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "table/experiment_run.hpp"

namespace kreisel::core {

struct Layout;

/// A parsed experiment file.
struct Experiment {
  std::string name;                      ///< stem of the file; the folder of its records
  std::string title;                     ///< one line; the name when the file gives none
  std::string about;                     ///< the comment that opens the file, without its marks
  std::string table = "runs";            ///< a name of table_summaries()
  std::shared_ptr<const Layout> layout;  ///< of a [table] of its own; else none
  std::vector<std::string> figures;      ///< scripts of plots/ that draw its records, without ".py"
  std::string published;  ///< published numbers to print beside ours, see published_file(); may be empty
  std::vector<ExperimentRun> runs;
};

/// Reads an experiment. Top-level keys are defaults of every run, `[[run]]` tables override them key by key,
/// and lists multiply out: the key that comes first in the file varies slowest.
///
///     title, table (see table_summaries(), or a layout), published, figures   of the experiment
///     label, mesh, kind                                  of a run, never lists
///     every field of the kind (run.hpp)                  a string, number or boolean (written yes or no)
///     set.GROUP.NAME or set."GROUP.NAME"                 solver, problem and formulation settings
///
/// The kind of a run is what `kind` says, or else what its fields do; with a table of nestings it is one.
///
/// @param file  for messages, and its stem for the name
/// @throws InputError  "FILE: line N: what, expected ...": bad TOML, unknown key, unfit value, no run
[[nodiscard]] Experiment parse_experiment(std::string_view text, const std::filesystem::path& file);

/// @throws InputError  unreadable file, or as parse_experiment()
[[nodiscard]] Experiment read_experiment(const std::filesystem::path& file);

/// The file of an experiment: the path itself, else experiments/NAME.toml here, else in data_folder().
///
/// @throws InputError  none of them; lists the names there are, or says that there is no data folder
[[nodiscard]] std::filesystem::path find_experiment(const std::string& name_or_path);

/// Names that find_experiment() accepts, sorted.
[[nodiscard]] std::vector<std::string> experiment_names();

}  // namespace kreisel::core
