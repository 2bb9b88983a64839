#include "experiment/speedup_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiment/child.hpp"
#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"
#include "experiment/text_table.hpp"

namespace kreisel::core {
namespace {

/// A model and grid, solved two ways, or three. Sides point into the list of runs; nullptr: not in the
/// experiment.
struct Row {
  std::string model, grid;
  const RecordedRun *rayrep = nullptr, *voxel = nullptr, *quadric = nullptr;
  const PublishedRow* published = nullptr;
};

struct Group {
  std::string label;
  std::vector<Row> rows;
};

bool has(const RecordedRun* side) { return side && has_result(*side); }

bool comparable(const RecordedRun* side) { return side && is_converged(*side); }

std::vector<Group> groups_of(const std::vector<RecordedRun>& runs,
                             const std::optional<Published>& published) {
  std::vector<Group> groups;
  for (const RecordedRun& run : runs) {
    const Asked& config = run.run.asked();
    Group& group = find_or_add(
        groups, [&](const Group& g) { return g.label == run.run.label; },
        [&] {
          return Group{run.run.label, {}};
        });
    const std::string model = model_text(config), grid = grid_text(config.grid);
    Row& row = find_or_add(
        group.rows, [&](const Row& r) { return r.model == model && r.grid == grid; },
        [&] { return Row{model, grid, nullptr, nullptr, nullptr, nullptr}; });
    if (config.formulation == "rayrep") row.rayrep = &run;
    if (config.formulation == "voxel") row.voxel = &run;
    if (config.formulation == "quadric") row.quadric = &run;
    if (const PublishedRow* found = find_row(run, published)) row.published = found;
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

/// Seconds of `slow` over those of `fast`.
std::optional<double> times_faster(const RecordedRun* fast, const RecordedRun* slow) {
  if (!comparable(fast) || !comparable(slow) || fast->record->median.solve <= 0) return std::nullopt;
  return slow->record->median.solve / fast->record->median.solve;
}

std::optional<double> speedup(const Row& row) { return times_faster(row.rayrep, row.voxel); }

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

/// Seconds as they are printed: marked where the solve did not end well, and what was ended at a limit has
/// that limit in their place.
Cell marked(const RecordedRun* side, Cell seconds) {
  if (!side || !side->record || is_optimal(*side)) return seconds;
  if (is_limit(side->run.solve().limits, side->record->error)) seconds.text = side->record->error;
  seconds.text += " !";
  return seconds;
}

void add_side(std::vector<Cell>& cells, const RecordedRun* side,
              const std::optional<PublishedRow::Side>& there) {
  RecordedRun nothing;
  SolveCells solve(side ? *side : nothing);
  solve.seconds = marked(side, std::move(solve.seconds));
  cells.insert(cells.end(), {solve.variables, solve.seconds, solve.half_iqr, solve.samples, solve.iterations,
                             solve.objective, side ? termination_text(*side) : "",
                             there ? fmt::format("{}", there->variables) : "",
                             there ? fmt::format("{}", there->seconds) : "", solve.setup});
}

/// "ipopt, hessian_approximation=exact": what sets the runs of one side apart from the defaults.
std::string settings_text(const Group& group, const RecordedRun* Row::*side) {
  std::set<std::string> distinct;
  for (const Row& row : group.rows) {
    if (!(row.*side)) continue;
    const Asked& config = (row.*side)->run.asked();
    std::string text = solver_of(config);
    for (const auto& [name, value] : config.settings) text += fmt::format(", {}={}", name, value);
    distinct.insert(text);
  }
  return distinct.empty() ? "-" : fmt::format("{}", fmt::join(distinct, " | "));
}

std::vector<RecordedRun> members(const Group& group) {
  std::vector<RecordedRun> all;
  for (const Row& row : group.rows)
    for (const RecordedRun* side : {row.rayrep, row.voxel, row.quadric})
      if (side) all.push_back(*side);
  return all;
}

/// What the columns are: some are there only where some run has them. Where quadrics are, people see fewer of
/// the others, so that a row still fits on a line; programs see all.
struct Layout {
  bool certified, quadric;
};

std::vector<Sheet::Column> columns(const Layout& layout) {
  std::vector<Sheet::Column> all = {{"label", "", "", true},
                                    {"model", "", "", true},
                                    {"grid", "", "", true},
                                    {"", "", "model, grid", true}};
  for (const std::string side : {"rayrep", "voxel"}) {
    const std::string group = side == "rayrep" ? "ray-rep" : side;
    const auto add = [&](const char* data, const char* heading, bool hidden = false) {
      all.push_back({side + '_' + data, group, heading, false, hidden});
    };
    add("variables", "vars", layout.quadric);
    add("seconds", "seconds");
    for (const char* data : {"seconds_half_iqr", "samples"}) add(data, "");
    add("iterations", "iter", layout.quadric);
    add("objective", "f", layout.quadric && layout.certified);
    for (const char* data : {"termination", "published_variables", "published_seconds"}) add(data, "");
    add("setup_seconds", "set-up", true);
  }
  all.insert(all.end(), {{"objective_difference_percent", "f", "diff %", false, layout.quadric},
                         {"speedup", "speed-up", "here"},
                         {"published_speedup", "speed-up", "paper"},
                         {"speedup_ratio", "speed-up", "ratio", false, layout.quadric},
                         {"rayrep_variables_excess_percent", "vars, %", "ray", false, layout.quadric},
                         {"voxel_variables_excess_percent", "vars, %", "voxel", false, layout.quadric}});
  if (layout.quadric)
    all.insert(all.end(), {{"quadric_seconds", "quadric", "seconds"},
                           {"quadric_setup_seconds", "quadric", "set-up"},
                           {"quadric_seconds_half_iqr", "quadric", ""},
                           {"quadric_samples", "quadric", ""},
                           {"quadric_iterations", "quadric", ""},
                           {"quadric_objective", "quadric", "f"},
                           {"quadric_termination", "quadric", ""},
                           {"quadric_faster_than_rayrep", "faster than", "ray"},
                           {"quadric_faster_than_voxel", "faster than", "voxel"}});
  if (!layout.certified) return all;
  all.insert(all.end(), {{"rayrep_gap_percent", "gap, %", "ray"}, {"voxel_gap_percent", "gap, %", "voxel"}});
  if (layout.quadric) all.push_back({"quadric_gap_percent", "gap, %", "quadric"});
  return all;
}

void add_quadric(std::vector<Cell>& cells, const Row& row) {
  const RecordedRun nothing;
  SolveCells solve(row.quadric ? *row.quadric : nothing);
  solve.seconds = marked(row.quadric, std::move(solve.seconds));
  cells.insert(cells.end(), {solve.seconds, solve.setup, solve.half_iqr, solve.samples, solve.iterations,
                             solve.objective, row.quadric ? termination_text(*row.quadric) : "",
                             Cell::of(times_faster(row.quadric, row.rayrep), "{:.0f}"),
                             Cell::of(times_faster(row.quadric, row.voxel), "{:.0f}")});
}

Block block_of(const Group& group, const std::optional<Published>& published, const Layout& layout) {
  Block block{fmt::format("{}\n  ray-rep: {}\n  voxel:   {}", group.label.empty() ? "all runs" : group.label,
                          settings_text(group, &Row::rayrep), settings_text(group, &Row::voxel)),
              Sheet(columns(layout)),
              {}};
  if (layout.quadric) block.heading += "\n  quadric: " + settings_text(group, &Row::quadric);
  for (const Row& row : group.rows) {
    const std::string name = row.model + ' ' + row.grid;
    std::vector<Cell> cells = {group.label, row.model, row.grid, name};
    add_side(cells, row.rayrep, published_side(row, true));
    add_side(cells, row.voxel, published_side(row, false));
    cells.insert(cells.end(), {Cell::of(difference(row), "{:+.3f}"), Cell::of(speedup(row), "{:.2f}"),
                               Cell::of(published_speedup(row), "{:.2f}"), Cell::of(ratio(row), "{:.2f}"),
                               Cell::of(excess(row.rayrep, published_side(row, true)), "{:+.1f}"),
                               Cell::of(excess(row.voxel, published_side(row, false)), "{:+.1f}")});
    if (layout.quadric) add_quadric(cells, row);
    if (layout.certified) {
      cells.push_back(row.rayrep ? gap_cell(*row.rayrep) : Cell::none());
      cells.push_back(row.voxel ? gap_cell(*row.voxel) : Cell::none());
      if (layout.quadric) cells.push_back(row.quadric ? gap_cell(*row.quadric) : Cell::none());
    }
    block.sheet.add(std::move(cells));
    if (row.rayrep) block.notes += note_of(*row.rayrep, true, name + ", ray-rep");
    if (row.voxel) block.notes += note_of(*row.voxel, true, name + ", voxel");
    if (row.quadric) block.notes += note_of(*row.quadric, true, name + ", quadric");
  }
  block.notes += provenance_text(members(group)) + '\n';
  if (published) block.notes += fmt::format("paper: {}\n", published->machine);
  return block;
}

}  // namespace

Tables speedup_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  Tables tables;
  const Layout layout{any_certified(runs), std::ranges::any_of(runs, [](const RecordedRun& run) {
                        return run.run.asked().formulation == "quadric";
                      })};
  for (const Group& group : groups_of(runs, published))
    tables.blocks.push_back(block_of(group, published, layout));
  tables.legend =
      "seconds: median ± half the interquartile range of the solve, set-up excluded; f: objective; speed-up: "
      "voxel seconds / ray-rep seconds\n";
  if (layout.quadric)
    tables.legend += "set-up: seconds from the model to its columns, much the same for all three\n";
  tables.legend +=
      layout.quadric
          ? "faster than: how many times the quadric's seconds the others take, on the same domain\n"
          : "diff %: ray-rep's f above voxel's; ratio: here / paper; vars, %: our counts of "
            "variables above the paper's\n";
  if (layout.certified) tables.legend += certified_legend;
  if (published) tables.legend += published->source + '\n';
  return tables;
}

}  // namespace kreisel::core
