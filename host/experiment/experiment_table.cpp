#include "experiment/experiment_table.hpp"

#include <fmt/format.h>

#include <map>

#include "experiment/absent_files.hpp"
#include "table/data_folder.hpp"
#include "table/layout_table.hpp"
#include "table/table_kinds.hpp"

namespace kreisel::core {
namespace {

/// Of runs that are on record, or could be.
Tables tables_of_present(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  std::optional<Published> published;
  if (!experiment.published.empty()) published = read_published(published_file(experiment.published));
  if (experiment.layout) return tables_of(*experiment.layout, runs, published);
  if (const TableKind* kind = find_table_kind(experiment.table)) return kind->make(runs, published);
  return tables_of(find_layout(experiment.table), runs, published);
}

}  // namespace

Tables tables_of(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  std::vector<std::string> lacks;  // of each run
  std::map<std::string, int> absent;
  for (const RecordedRun& run : runs) {
    lacks.push_back(run.record ? "" : text_of_absent(run.run));
    if (!lacks.back().empty()) ++absent[lacks.back()];
  }
  if (absent.empty()) return tables_of_present(experiment, runs);  // not copied: there may be many
  std::vector<RecordedRun> present;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (lacks[i].empty()) present.push_back(runs[i]);
  Tables tables = tables_of_present(experiment, present);
  for (const auto& [what, count] : absent)
    tables.legend += fmt::format("left out: {} run{}, {}\n", count, count == 1 ? "" : "s", what);
  return tables;
}

std::string table_text(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  return experiment.title + "\n\n" + to_text(tables_of(experiment, runs));
}

std::string table_csv(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  return to_csv(tables_of(experiment, runs));
}

}  // namespace kreisel::core
