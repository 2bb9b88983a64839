#include "table/table_kinds.hpp"

#include <algorithm>

#include "table/inertia_table.hpp"
#include "table/layout.hpp"
#include "table/nest_variants_table.hpp"
#include "table/settings_table.hpp"
#include "table/starts_table.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {

const TableKind* find_table_kind(const std::string& name) {
  const auto at = std::ranges::find(table_kinds(), name, &TableKind::name);
  return at == table_kinds().end() ? nullptr : &*at;
}

const std::vector<TableKind>& table_kinds() {
  static const std::vector<TableKind> all = {
      {"settings",
       "a block a body, a row a setting: what does it gain, what does it cost",
       "solve",
       {"model", "grid", "problem", "formulation"},
       settings_tables},
      {"formulations",
       "a block a body, a row a formulation: what it takes and what it reaches",
       "solve",
       {"model", "grid", "problem"},
       formulations_tables},
      {"starts",
       "a row a task, over its starts: how many end at the optimum, in how many passes",
       "solve",
       {"label", "model", "grid", "problem"},
       starts_tables},
      {"inertia",
       "a block a run: inertia tensor and principal moments before and after",
       "solve",
       {},
       inertia_tables},
      {"nest-variants",
       "a row a setting of a search, over its seeds: scales with their spread, seconds",
       "nesting",
       {"shapes"},
       nest_variants_tables},
  };
  return all;
}

std::vector<std::pair<std::string, std::string>> table_summaries() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const TableKind& kind : table_kinds()) all.emplace_back(kind.name, kind.summary);
  for (const std::string& name : layout_names()) all.emplace_back(name, find_layout(name).summary);
  std::ranges::sort(all);
  return all;
}

std::string kind_set_out_by(const std::string& table) {
  if (const TableKind* kind = find_table_kind(table)) return std::string(kind->of);
  std::vector<std::string> names = layout_names();
  if (std::ranges::find(names, table) != names.end()) return find_layout(table).of;
  for (const TableKind& kind : table_kinds()) names.emplace_back(kind.name);
  std::ranges::sort(names);
  throw unknown_name("table", table, names);
}

}  // namespace kreisel::core
