// table.hpp - an experiment's records as tables: most by a layout, which is data; a few by code.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/layout.hpp"
#include "experiment/sheet.hpp"

namespace kreisel::core {

/// A way to set runs out that a layout cannot say: what a row shows depends on the other rows.
struct TableKind {
  std::string_view name, summary;
  std::string_view of;  ///< the kind of its runs, as Layout::of
  Tables (*make)(const std::vector<RecordedRun>& runs, const std::optional<Published>& published);
};

[[nodiscard]] const std::vector<TableKind>& table_kinds();

/// Names that `table = "NAME"` of an experiment may have, each with its summary, sorted.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> table_summaries();

/// The kind of run that a table sets out: solve, map, nesting; empty: any.
/// @throws InputError  unknown name; lists those there are
[[nodiscard]] std::string kind_set_out_by(const std::string& table);

/// The tables that the experiment names, beside the published numbers that it names. Runs that are not on
/// record and name an absent mesh file are left out, and the legend says so.
///
/// @throws InputError  published numbers or a layout that cannot be read
[[nodiscard]] Tables tables_of(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// tables_of() as aligned plain text under the title, of at most 150 columns (models and settings with long
/// names aside). Missing values are "-". Ends with a newline.
[[nodiscard]] std::string table_text(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// The same rows as CSV with a heading line; missing values are empty.
[[nodiscard]] std::string table_csv(const Experiment& experiment, const std::vector<RecordedRun>& runs);

}  // namespace kreisel::core
