// table.hpp - an experiment's records as a table; each kind of table is one file and one line here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/experiment.hpp"
#include "experiment/published.hpp"
#include "experiment/sheet.hpp"
#include "record/map_record.hpp"
#include "record/nest_record.hpp"
#include "record/record.hpp"
#include "record/simulation_record.hpp"

namespace kreisel::core {

/// A run of an experiment with what is on record for it.
struct RecordedRun {
  ExperimentRun run;
  std::optional<RecordSummary> record;  ///< of a solve, or of what failed; empty: it did not run yet
  std::optional<MapSummary> map;        ///< of a map
  std::optional<NestSummary> nest;      ///< of a nesting
  std::optional<SimulationSummary> simulation;

  /// The record's file; empty where there is none.
  [[nodiscard]] std::filesystem::path path() const {
    return nest         ? nest->path
           : map        ? map->path
           : simulation ? simulation->path
           : record     ? record->path
                        : std::filesystem::path();
  }
};

/// A way to set runs out, as `table = "NAME"` of an experiment names it.
struct TableKind {
  std::string_view name, summary;
  Tables (*make)(const std::vector<RecordedRun>& runs, const std::optional<Published>& published);
  bool nestings = false;            ///< sets out nestings
  std::string_view runs = "solve";  ///< else runs of this kind
};

[[nodiscard]] const std::vector<TableKind>& table_kinds();

/// @throws InputError  unknown name; lists those there are
[[nodiscard]] const TableKind& find_table_kind(std::string_view name);

/// Every run of the experiment, in the order of the file, with its record under `results`.
///
/// @throws InputError  a record that cannot be read
[[nodiscard]] std::vector<RecordedRun> collect(const Experiment& experiment,
                                               const std::filesystem::path& results);

/// The tables that the experiment names, beside the published numbers that it names. Runs that are not on
/// record and name an absent mesh file are left out, and the legend says so.
///
/// @throws InputError  published numbers that cannot be read
[[nodiscard]] Tables tables_of(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// tables_of() as aligned plain text under the title, of at most 150 columns (models and settings with long
/// names aside). Missing values are "-". Ends with a newline.
[[nodiscard]] std::string table_text(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// The same rows as CSV with a heading line; missing values are empty.
[[nodiscard]] std::string table_csv(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// "runs": a row a run, for any experiment.
[[nodiscard]] Tables runs_tables(const std::vector<RecordedRun>& runs,
                                 const std::optional<Published>& published);

}  // namespace kreisel::core
