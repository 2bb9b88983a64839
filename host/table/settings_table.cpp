#include "table/settings_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "solve/solver.hpp"
#include "table/across_nodes.hpp"
#include "table/experiment_run.hpp"
#include "table/table_parts.hpp"

namespace kreisel::core {
namespace {

using Fields = std::map<std::string, std::string>;

struct SettingsGroup {
  std::string name;
  std::vector<const RecordedRun*> runs;
};

/// What the rows of a block differ in.
enum class By { setting, formulation };

/// What a block has in its name; the rest of a configuration is settings.
Fields settings_of(const RecordedRun& run, By by) {
  Fields fields = fields_of(run.run);
  const bool own_solver = fields["solver"] == default_solver(fields["formulation"]).name;
  for (const char* key : {"model", "resolution", "problem"}) fields.erase(key);
  // A formulation has one solver of its own; another one is written in the experiment as a setting would be.
  if (by == By::formulation)
    for (const char* key : {"domain", "certify", "part"}) fields.erase(key);
  else
    fields.erase("formulation");
  if (by == By::formulation && own_solver) fields.erase("solver");
  return fields;
}

std::string text_in(const RecordedRun& run, std::string_view name) { return cell_of_column(run, name).data; }

/// Only interiors of one domain can be compared, so its name stands where formulations differ.
std::string name_of(const RecordedRun& run, By by) {
  const Fields fields = fields_of(run.run);
  const std::string body =
      fmt::format("{} {}, {}", text_in(run, "model"), fields.at("resolution"), fields.at("problem"));
  const auto domain = fields.find("domain");
  return by == By::setting
             ? fmt::format("{}, {}", body, fields.at("formulation"))
             : fmt::format("{}, domain {}", body, domain == fields.end() ? "columns" : domain->second);
}

std::vector<SettingsGroup> groups_of(const std::vector<RecordedRun>& runs, By by) {
  std::vector<SettingsGroup> groups;
  std::unordered_map<std::string, std::size_t> known;
  for (const RecordedRun& run : runs) {
    const auto [at, is_new] = known.try_emplace(name_of(run, by), groups.size());
    if (is_new) groups.push_back({at->first, {}});
    groups[at->second].runs.push_back(&run);
  }
  return groups;
}

/// The fields that have the same value in every run.
Fields common_fields(const SettingsGroup& group, By by) {
  Fields common = settings_of(*group.runs.front(), by);
  for (const RecordedRun* run : group.runs) {
    const Fields fields = settings_of(*run, by);
    std::erase_if(common, [&](const auto& field) {
      const auto at = fields.find(field.first);
      return at == fields.end() || at->second != field.second;
    });
  }
  return common;
}

/// "NAME=VALUE, ..." of those not in `common`. @param whole  names with their groups
std::string text_of(const Fields& fields, const Fields& common, bool whole) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : fields) {
    if (common.contains(name)) continue;
    const std::size_t dot = name.find('.');
    parts.push_back(
        fmt::format("{}={}", whole || dot == std::string::npos ? name : name.substr(dot + 1), value));
  }
  return parts.empty() ? "defaults" : fmt::format("{}", fmt::join(parts, ", "));
}

/// The lowest objective among the converged.
std::optional<double> best_of(const SettingsGroup& group) {
  std::optional<double> best;
  for (const RecordedRun* run : group.runs)
    if (const auto f = run->number("objective"); f && run->is_converged())
      best = std::min(best.value_or(*f), *f);
  return best;
}

Sheet empty_sheet(bool labels, bool certified, By by) {
  std::vector<Sheet::Column> columns = {{"model", "", "", true},
                                        {"grid", "", "", true},
                                        {"problem", "", "", true},
                                        {"formulation", "", "", true},
                                        {"label", "",
                                         !labels             ? ""
                                         : by == By::setting ? "factor"
                                                             : "label",
                                         true},
                                        {"setting", "", by == By::setting ? "setting" : "formulation", true},
                                        {"termination", "", "termination", true},
                                        {"iterations", "", "iter"},
                                        {"seconds", "", "seconds"},
                                        {"seconds_half_iqr", "", ""},
                                        {"samples", "", ""},
                                        {"seconds_over_first", "", "time x"},
                                        {"variables", "", "variables"},
                                        {"objective", "", "f"},
                                        {"objective_above_best_percent", "", "above best, %"},
                                        {"violation", "", "violation"},
                                        {"verified", "", "verified", true},
                                        {"setup_seconds", "", "set-up", false, true}};
  if (certified) columns.push_back({"gap_percent", "", "gap %"});
  return Sheet(std::move(columns));
}

/// "rayrep, bounds=midpoint": the formulation comes first, without its key.
std::string with_formulation(Fields fields, const Fields& common, bool whole) {
  const std::string formulation = fields["formulation"];
  fields.erase("formulation");
  const std::string rest = text_of(fields, common, whole);
  return rest == "defaults" ? formulation : fmt::format("{}, {}", formulation, rest);
}

/// @param best  of the block, best_of()
void add_row(Block& block, const RecordedRun& first, const RecordedRun& run, const Fields& common,
             const std::optional<double>& best, bool certified, By by) {
  std::optional<double> time, above;
  if (run.is_converged()) {
    const auto here = run.number("seconds.solve"), there = first.number("seconds.solve");
    if (first.is_converged() && here && there && *there > 0) time = *here / *there;
    const auto f = run.number("objective");
    if (best && f && *best != 0) above = (*f - *best) / std::abs(*best) * 100;
  }
  const Fields fields = settings_of(run, by);
  const auto text = [&](bool whole) {
    return by == By::setting ? text_of(fields, common, whole) : with_formulation(fields, common, whole);
  };
  const std::string setting = text(false);
  const bool same_as_before =
      !block.sheet.rows().empty() && block.sheet.rows().back()[4].data == run.run.label;
  std::vector<Cell> cells;
  const auto add = [&](std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) cells.push_back(cell_of_column(run, name));
  };
  add({"model", "grid", "problem", "formulation"});
  cells.emplace_back(same_as_before ? "" : run.run.label, run.run.label);
  cells.emplace_back(setting, text(true));
  add({"termination", "iterations", "seconds", "seconds_half_iqr", "samples"});
  cells.push_back(Cell::of(time, "{:.2f}"));
  if (time && are_across_nodes(first, run)) mark_across_nodes(cells.back());
  add({"variables", "objective"});
  cells.push_back(Cell::of(above, "{:.3f}"));
  add({"violation", "verified", "setup_seconds"});
  if (certified) add({"gap_percent"});
  block.sheet.add(std::move(cells));
  block.notes += note_of(run, true, setting);
}

Tables tables_by(By by, const std::vector<RecordedRun>& runs) {
  const bool labels = std::ranges::any_of(runs, [](const auto& run) { return !run.run.label.empty(); });
  const bool certified = any_certified(runs);
  Tables tables;
  for (const SettingsGroup& group : groups_of(runs, by)) {
    const Fields common = common_fields(group, by);
    Block block{fmt::format("{}; in all: {}", group.name, text_of(common, {}, true)),
                empty_sheet(labels, certified, by),
                {}};
    const std::optional<double> best = best_of(group);
    for (const RecordedRun* run : group.runs)
      add_row(block, *group.runs.front(), *run, common, best, certified, by);
    tables.blocks.push_back(std::move(block));
  }
  tables.legend =
      "seconds: median ± half the interquartile range of the solve, set-up excluded; time x: relative to the "
      "first row;\n"
      "f: objective; above best: relative to the lowest of the block; violation: the largest of the "
      "constraints, body units;\n"
      "times and distances are those of converged solves\n";
  if (certified) tables.legend += certified_legend;
  tables.legend += across_nodes_legend(tables);
  tables.legend += provenance_text(pointers(runs)) + '\n';
  return tables;
}

}  // namespace

Tables settings_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  return tables_by(By::setting, runs);
}

Tables formulations_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  return tables_by(By::formulation, runs);
}

}  // namespace kreisel::core
