#include "experiment/linear_solver_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"

namespace kreisel::core {
namespace {

struct SolverRow {
  std::string label, name, formulation;
  const RecordedRun *mumps = nullptr, *own = nullptr;
};

std::vector<SolverRow> rows_of(const std::vector<RecordedRun>& runs) {
  std::vector<SolverRow> rows;
  for (const RecordedRun& run : runs) {
    const Asked& config = run.run.asked();
    const std::string name = model_text(config) + ' ' + grid_text(run);
    SolverRow& row = find_or_add(
        rows,
        [&](const SolverRow& r) {
          return r.label == run.run.label && r.name == name && r.formulation == config.formulation;
        },
        [&] {
          return SolverRow{run.run.label, name, config.formulation};
        });
    const auto solver = config.settings.find("ipopt.linear_solver");
    (solver != config.settings.end() && solver->second == "mumps" ? row.mumps : row.own) = &run;
  }
  return rows;
}

std::optional<double> an_iteration(const RecordedRun& run) {
  if (!has_result(run) || run.record->iterations == 0) return std::nullopt;
  return 1e3 * run.record->median.solve / run.record->iterations;
}

void add_side(std::vector<Cell>& cells, const RecordedRun* run) {
  const RecordedRun nothing;
  const RecordedRun& side = run ? *run : nothing;
  SolveCells solve(side);
  if (has_result(side) && !is_optimal(side)) solve.seconds.text += " !";
  cells.insert(cells.end(), {solve.seconds, solve.half_iqr, solve.samples, solve.iterations,
                             Cell::of(an_iteration(side), "{:.2f}"), solve.objective});
}

std::vector<Cell> cells_of(const SolverRow& row) {
  const SolveCells any(row.own ? *row.own : *row.mumps);
  std::vector<Cell> cells = {row.label, row.name, row.formulation, any.variables};
  add_side(cells, row.mumps);
  add_side(cells, row.own);
  std::optional<double> faster, difference;
  if (row.mumps && row.own && is_converged(*row.mumps) && is_converged(*row.own)) {
    const RecordSummary &there = *row.mumps->record, &here = *row.own->record;
    if (here.median.solve > 0) faster = there.median.solve / here.median.solve;
    if (there.objective != 0) difference = std::abs(here.objective / there.objective - 1);
  }
  cells.push_back(Cell::of(faster, "{:.1f}"));
  cells.push_back(Cell::of(difference, "{:.0e}"));
  return cells;
}

Sheet linear_solver_sheet() {
  std::vector<Sheet::Column> columns = {{"label", "", "setting", true},
                                        {"", "", "model, grid", true},
                                        {"formulation", "", "formulation", true},
                                        {"variables", "", "variables"}};
  columns[1].data = "model_grid";
  for (const std::string side : {"mumps", "arrow"}) {
    const std::string group = side == "mumps" ? "MUMPS" : side;
    columns.insert(columns.end(), {{side + "_seconds", group, "seconds"},
                                   {side + "_seconds_half_iqr", group, ""},
                                   {side + "_samples", group, ""},
                                   {side + "_iterations", group, "iter"},
                                   {side + "_ms_an_iteration", group, "ms/iter"},
                                   {side + "_objective", group, ""}});
  }
  columns.push_back({"times_faster", "arrow is", "x faster"});
  columns.push_back({"objective_difference", "f", "differs"});
  return Sheet(std::move(columns));
}

}  // namespace

Tables linear_solver_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Sheet sheet = linear_solver_sheet();
  std::string notes;
  for (const SolverRow& row : rows_of(runs)) {
    sheet.add(cells_of(row));
    for (const RecordedRun* run : {row.mumps, row.own})
      if (run) notes += note_of(*run, true, row.name + ", " + row.formulation + ", " + row.label);
  }
  return {
      {{"", std::move(sheet), notes}},
      "seconds: median ± half the interquartile range of the solve, set-up excluded; differs: relative. " +
          provenance_text(runs) + '\n'};
}

}  // namespace kreisel::core
