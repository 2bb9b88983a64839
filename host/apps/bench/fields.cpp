#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/bench/commands.hpp"
#include "formulation/formulation.hpp"
#include "solve/solver.hpp"

namespace kreisel::core::bench {
namespace {

/// A field, and the kinds that have it with this meaning.
struct Row {
  Field<Run> field;
  std::vector<std::string_view> kinds;
};

/// Those of all kinds, or of one; those that mean the same once.
std::vector<Row> rows_of(const std::string& only) {
  std::vector<Row> rows;
  for (const RunKind& kind : run_kinds()) {
    if (!only.empty() && kind.name != only) continue;
    for (const Field<Run>& field : kind.fields) {
      const auto same = std::ranges::find_if(
          rows, [&](const Row& row) { return row.field.name == field.name && row.field.help == field.help; });
      if (same != rows.end())
        same->kinds.push_back(kind.name);
      else
        rows.push_back({field, {kind.name}});
    }
  }
  return rows;
}

/// For a cell of a Markdown table.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

void print_markdown(const std::vector<Row>& rows) {
  fmt::print("| kind | what it is | its settings, under `set` |\n|---|---|---|\n");
  for (const RunKind& kind : run_kinds())
    fmt::print("| `{}` | {} | {} |\n", kind.name, escaped(kind.help),
               kind.groups.empty() ? "none" : fmt::format("{}", fmt::join(kind.groups, ", ")));
  fmt::print("\n| field | unit | what it says | kinds |\n|---|---|---|---|\n");
  for (const Row& row : rows)
    fmt::print("| `{}` | {} | {} | {} |\n", row.field.name, row.field.unit, escaped(row.field.help),
               fmt::join(row.kinds, ", "));
}

/// A group of settings that are no fields, by whom it is read.
struct Group {
  std::string_view name, of;
  const SettingTable* table;
};

std::vector<Group> groups_of_settings() {
  std::vector<Group> all = {{"solver", "every solver", &solver_settings()}};
  for (const FormulationEntry& entry : formulations())
    all.push_back({"formulation", entry.name, &entry.settings});
  for (const SolverEntry& entry : solvers()) all.push_back({entry.name, entry.name, &entry.settings});
  return all;
}

/// Those of a solver that has hundreds are in its own documentation.
void print_settings() {
  constexpr std::size_t few = 20;
  fmt::print("\n| setting | unit | what it says | of |\n|---|---|---|---|\n");
  for (const Group& group : groups_of_settings()) {
    const Fields<Settings>& fields = group.table->fields();
    if (fields.size() > few)
      fmt::print("| `{}.NAME` | | any of its {} own options | {} |\n", group.name, fields.size(), group.of);
    else
      for (const Field<Settings>& field : fields)
        fmt::print("| `{}.{}` | {} | {} | {} |\n", group.name, field.name, field.unit, escaped(field.help),
                   group.of);
  }
}

void print_plain(const std::vector<Row>& rows) {
  std::string_view group;
  for (const Row& row : rows) {
    if (row.field.group != group) fmt::print("{}\n", group = row.field.group);
    fmt::print("  {:<22} {}{}\n", row.field.name,
               row.field.unit.empty() ? "" : fmt::format("[{}] ", row.field.unit), row.field.help);
  }
}

}  // namespace

int fields(const FieldsOptions& options) {
  if (!options.kind.empty()) (void)find_run_kind(options.kind);
  const std::vector<Row> rows = rows_of(options.kind);
  if (options.markdown) {
    print_markdown(rows);
    if (options.kind.empty()) print_settings();
    return done;
  }
  if (options.kind.empty()) {
    fmt::print("kinds of runs (bench fields KIND)\n");
    for (const RunKind& kind : run_kinds()) fmt::print("  {:<12} {}\n", kind.name, kind.help);
    return done;
  }
  print_plain(rows);
  return done;
}

}  // namespace kreisel::core::bench
