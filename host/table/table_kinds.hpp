// table_kinds.hpp - the tables that there are: most are layouts, which are data; a few are code.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "table/published.hpp"
#include "table/recorded_run.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// A way to set runs out that a layout cannot say: what a row shows depends on the other rows.
struct TableKind {
  std::string_view name, summary;
  std::string_view of;  ///< the kind of its runs, as Layout::of
  /// What runs have in common that a row or a block sets beside each other; nothing: each stands for itself.
  std::vector<std::string_view> compares;
  Tables (*make)(const std::vector<RecordedRun>& runs, const std::optional<Published>& published);
};

[[nodiscard]] const std::vector<TableKind>& table_kinds();
/// nullptr: there is none of that name; it may be a layout's.
[[nodiscard]] const TableKind* find_table_kind(const std::string& name);

/// Names that `table = "NAME"` of an experiment may have, each with its summary, sorted.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> table_summaries();

/// The kind of run that a table sets out: solve, map, nesting; empty: any.
/// @throws InputError  unknown name; lists those there are
[[nodiscard]] std::string kind_set_out_by(const std::string& table);

}  // namespace kreisel::core
