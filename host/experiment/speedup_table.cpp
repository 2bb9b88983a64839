#include "experiment/speedup_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"
#include "experiment/text_table.hpp"

namespace kreisel {
namespace {

/// A model and grid, solved both ways. Sides point into the list of runs; nullptr: not in the experiment.
struct Row {
  std::string model, grid;
  const RecordedRun *rayrep = nullptr, *voxel = nullptr;
  const PublishedRow* published = nullptr;
};

struct Group {
  std::string label;
  std::vector<Row> rows;
};

bool has(const RecordedRun* side) { return side && has_result(*side); }

bool comparable(const RecordedRun* side) {
  return has(side) && (side->record->termination == "optimal" || side->record->termination == "acceptable");
}

std::optional<std::array<int, 3>> cells_of(const RecordedRun& run) {
  if (run.run.config.grid.cells) return run.run.config.grid.cells;
  if (has_result(run)) return run.record->grid;
  return std::nullopt;
}

template <class Item, class Matches, class Make>
Item& find_or_add(std::vector<Item>& items, Matches matches, Make make) {
  const auto at = std::find_if(items.begin(), items.end(), matches);
  return at != items.end() ? *at : items.emplace_back(make());
}

std::vector<Group> groups_of(const std::vector<RecordedRun>& runs,
                             const std::optional<Published>& published) {
  std::vector<Group> groups;
  for (const RecordedRun& run : runs) {
    const RunConfig& config = run.run.config;
    Group& group = find_or_add(
        groups, [&](const Group& g) { return g.label == run.run.label; },
        [&] {
          return Group{run.run.label, {}};
        });
    const std::string model = model_text(config), grid = grid_text(config.grid);
    Row& row = find_or_add(
        group.rows, [&](const Row& r) { return r.model == model && r.grid == grid; },
        [&] {
          return Row{model, grid, nullptr, nullptr, nullptr};
        });
    if (config.formulation == "rayrep") row.rayrep = &run;
    if (config.formulation == "voxel") row.voxel = &run;
    if (const auto cells = cells_of(run); cells && published) row.published = published->find(model, *cells);
  }
  if (published)
    for (Group& group : groups) {
      const auto place = [&](const Row& row) {
        return row.published ? row.published - published->rows.data()
                             : static_cast<std::ptrdiff_t>(published->rows.size());
      };
      std::stable_sort(group.rows.begin(), group.rows.end(),
                       [&](const Row& a, const Row& b) { return place(a) < place(b); });
    }
  return groups;
}

std::optional<double> speedup(const Row& row) {
  if (!comparable(row.rayrep) || !comparable(row.voxel) || row.rayrep->record->median.solve <= 0)
    return std::nullopt;
  return row.voxel->record->median.solve / row.rayrep->record->median.solve;
}

std::optional<double> published_speedup(const Row& row) {
  return row.published ? row.published->speedup : std::nullopt;
}

std::optional<double> ratio(const Row& row) {
  const auto here = speedup(row), there = published_speedup(row);
  return here && there ? std::optional(*here / *there) : std::nullopt;
}

/// How far the ray-rep's objective lies above the voxels', per cent.
std::optional<double> difference(const Row& row) {
  if (!comparable(row.rayrep) || !comparable(row.voxel) || row.voxel->record->objective == 0)
    return std::nullopt;
  const double voxel = row.voxel->record->objective;
  return (row.rayrep->record->objective - voxel) / std::abs(voxel) * 100;
}

/// How far the count of variables lies above the published, per cent.
std::optional<double> excess(const RecordedRun* side, const std::optional<PublishedRow::Side>& published) {
  if (!has(side) || !published) return std::nullopt;
  return (static_cast<double>(side->record->variables) / published->variables - 1) * 100;
}

std::optional<PublishedRow::Side> published_side(const Row& row, bool rays) {
  if (!row.published) return std::nullopt;
  return rays ? row.published->rayrep : row.published->voxel;
}

std::string cell(const std::optional<double>& value, fmt::format_string<const double&> format,
                 const char* missing = "-") {
  return value ? fmt::format(format, *value) : missing;
}

void add_side(std::vector<std::string>& cells, const RecordedRun* side) {
  if (!has(side)) {
    cells.insert(cells.end(), {"-", side && side->record ? "- !" : "-", "-", "-"});
    return;
  }
  const RecordSummary& r = *side->record;
  cells.insert(cells.end(),
               {fmt::format("{}", r.variables), seconds_text(r) + (is_optimal(*side) ? "" : " !"),
                fmt::format("{}", r.iterations), fmt::format("{:.6g}", r.objective)});
}

/// "ipopt, hessian_approximation=exact": what sets the runs of one side apart from the defaults.
std::string settings_text(const Group& group, const RecordedRun* Row::*side) {
  std::set<std::string> distinct;
  for (const Row& row : group.rows) {
    if (!(row.*side)) continue;
    const RunConfig& config = (row.*side)->run.config;
    std::string text = config.solver;
    for (const auto& [name, value] : config.settings) text += fmt::format(", {}={}", name, value);
    distinct.insert(text);
  }
  return distinct.empty() ? "-" : fmt::format("{}", fmt::join(distinct, " | "));
}

void add_note(std::string& notes, const Row& row, const RecordedRun* side, std::string_view name) {
  if (!side || !side->record || is_optimal(*side)) return;
  const RecordSummary& r = *side->record;
  const std::string& words = r.error.empty() ? r.message : r.error;
  notes += fmt::format("! {} {}, {}: {}{}{}\n", row.model, row.grid, name, termination_text(*side),
                       words.empty() ? "" : " - ", words);
}

std::vector<RecordedRun> members(const Group& group) {
  std::vector<RecordedRun> all;
  for (const Row& row : group.rows)
    for (const RecordedRun* side : {row.rayrep, row.voxel})
      if (side) all.push_back(*side);
  return all;
}

std::string group_text(const Group& group, const std::optional<Published>& published) {
  TextTable table({{"", "model, grid", true},
                   {"ray-rep", "vars"},
                   {"ray-rep", "seconds"},
                   {"ray-rep", "iter"},
                   {"ray-rep", "f"},
                   {"voxel", "vars"},
                   {"voxel", "seconds"},
                   {"voxel", "iter"},
                   {"voxel", "f"},
                   {"f", "diff %"},
                   {"speed-up", "here"},
                   {"speed-up", "paper"},
                   {"speed-up", "ratio"},
                   {"vars, %", "ray"},
                   {"vars, %", "voxel"}});
  std::string notes;
  for (const Row& row : group.rows) {
    std::vector<std::string> cells = {row.model + ' ' + row.grid};
    add_side(cells, row.rayrep);
    add_side(cells, row.voxel);
    cells.insert(cells.end(), {cell(difference(row), "{:+.3f}"), cell(speedup(row), "{:.2f}"),
                               cell(published_speedup(row), "{:.2f}"), cell(ratio(row), "{:.2f}"),
                               cell(excess(row.rayrep, published_side(row, true)), "{:+.1f}"),
                               cell(excess(row.voxel, published_side(row, false)), "{:+.1f}")});
    table.add(cells);
    add_note(notes, row, row.rayrep, "ray-rep");
    add_note(notes, row, row.voxel, "voxel");
  }
  std::string text =
      fmt::format("{}\n  ray-rep: {}\n  voxel:   {}\n", group.label.empty() ? "all runs" : group.label,
                  settings_text(group, &Row::rayrep), settings_text(group, &Row::voxel));
  text += table.text() + notes + provenance_text(members(group)) + '\n';
  if (published) text += fmt::format("paper: {}\n", published->machine);
  return text;
}

}  // namespace

std::string speedup_table(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  std::string text;
  for (const Group& group : groups_of(runs, published)) text += group_text(group, published) + '\n';
  text +=
      "seconds: median ± half the interquartile range of the solve, set-up excluded; f: objective; diff %: "
      "ray-rep's f above voxel's;\n"
      "speed-up: voxel seconds / ray-rep seconds; ratio: here / paper; vars, %: our counts of variables "
      "above the "
      "paper's\n";
  if (published) text += published->source + '\n';
  return text;
}

std::string speedup_csv(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  std::vector<std::string> heading = {"label", "model", "grid"};
  for (const std::string side : {"rayrep", "voxel"})
    for (const std::string field : {"variables", "seconds", "seconds_half_iqr", "samples", "iterations",
                                    "objective", "termination", "published_variables", "published_seconds"})
      heading.push_back(side + '_' + field);
  heading.insert(heading.end(),
                 {"objective_difference_percent", "speedup", "published_speedup", "speedup_ratio",
                  "rayrep_variables_excess_percent", "voxel_variables_excess_percent"});
  std::string csv = csv_line(heading);
  for (const Group& group : groups_of(runs, published))
    for (const Row& row : group.rows) {
      std::vector<std::string> cells = {group.label, row.model, row.grid};
      for (const bool rays : {true, false}) {
        const RecordedRun* side = rays ? row.rayrep : row.voxel;
        if (has(side)) {
          const RecordSummary& r = *side->record;
          cells.insert(cells.end(), {fmt::format("{}", r.variables), fmt::format("{}", r.median.solve),
                                     fmt::format("{}", half_interquartile_range(r.samples)),
                                     fmt::format("{}", r.samples.size()), fmt::format("{}", r.iterations),
                                     fmt::format("{}", r.objective)});
        } else {
          cells.insert(cells.end(), 6, "");
        }
        cells.push_back(side ? termination_text(*side) : "");
        const auto there = published_side(row, rays);
        cells.push_back(there ? fmt::format("{}", there->variables) : "");
        cells.push_back(there ? fmt::format("{}", there->seconds) : "");
      }
      for (const auto& value :
           {difference(row), speedup(row), published_speedup(row), ratio(row),
            excess(row.rayrep, published_side(row, true)), excess(row.voxel, published_side(row, false))})
        cells.push_back(cell(value, "{}", ""));
      csv += csv_line(cells);
    }
  return csv;
}

}  // namespace kreisel
