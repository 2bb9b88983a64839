#include "experiment/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiment/absent_files.hpp"
#include "experiment/data_folder.hpp"
#include "experiment/inertia_table.hpp"
#include "experiment/layout_table.hpp"
#include "experiment/nest_variants_table.hpp"
#include "experiment/settings_table.hpp"
#include "experiment/starts_table.hpp"
#include "unknown_name.hpp"

namespace kreisel::core {
namespace {

const TableKind* find_kind(const std::string& name) {
  const auto at = std::ranges::find(table_kinds(), name, &TableKind::name);
  return at == table_kinds().end() ? nullptr : &*at;
}

}  // namespace

const std::vector<TableKind>& table_kinds() {
  static const std::vector<TableKind> all = {
      {"settings", "a block a body, a row a setting: what does it gain, what does it cost", "solve",
       settings_tables},
      {"formulations", "a block a body, a row a formulation: what it takes and what it reaches", "solve",
       formulations_tables},
      {"starts", "a row a task, over its starts: how many end at the optimum, in how many passes", "solve",
       starts_tables},
      {"inertia", "a block a run: inertia tensor and principal moments before and after", "solve",
       inertia_tables},
      {"nest-variants", "a row a setting of a search, over its seeds: scales with their spread, seconds",
       "nesting", nest_variants_tables},
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
  if (const TableKind* kind = find_kind(table)) return std::string(kind->of);
  std::vector<std::string> names = layout_names();
  if (std::ranges::find(names, table) != names.end()) return find_layout(table).of;
  for (const TableKind& kind : table_kinds()) names.emplace_back(kind.name);
  std::ranges::sort(names);
  throw unknown_name("table", table, names);
}

Tables tables_of(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  std::optional<Published> published;
  if (!experiment.published.empty()) published = read_published(published_file(experiment.published));
  std::vector<RecordedRun> present;
  std::map<std::string, int> absent;  // runs by what they lack
  for (const RecordedRun& run : runs) {
    const std::string lacks = run.record ? "" : text_of_absent(run.run);
    if (lacks.empty())
      present.push_back(run);
    else
      ++absent[lacks];
  }
  const TableKind* kind = find_kind(experiment.table);
  Tables tables = experiment.layout ? tables_of(*experiment.layout, present, published)
                  : kind            ? kind->make(present, published)
                                    : tables_of(find_layout(experiment.table), present, published);
  for (const auto& [lacks, count] : absent)
    tables.legend += fmt::format("left out: {} run{}, {}\n", count, count == 1 ? "" : "s", lacks);
  return tables;
}

std::string table_text(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  return experiment.title + "\n\n" + to_text(tables_of(experiment, runs));
}

std::string table_csv(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  return to_csv(tables_of(experiment, runs));
}

}  // namespace kreisel::core
