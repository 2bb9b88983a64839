#include "experiment/experiment_table.hpp"

#include <fmt/format.h>

#include <map>

#include "experiment/absent_files.hpp"
#include "table/data_folder.hpp"
#include "table/layout_table.hpp"
#include "table/table_kinds.hpp"

namespace kreisel::core {
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
  const TableKind* kind = find_table_kind(experiment.table);
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
