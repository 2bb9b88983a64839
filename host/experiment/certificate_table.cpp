#include "experiment/certificate_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"

namespace kreisel::core {
namespace {

Sheet empty_sheet(bool labels) {
  return sheet_of_runs({{"domain", "", "domain", true},
                        {"rays", "", "rays"},
                        {"termination", "", "termination", true},
                        {"seconds", "solve", "seconds"},
                        {"objective", "solve", "f"},
                        {"certificate", "certificate", "kind", true},
                        {"bound", "certificate", "bound"},
                        {"gap_percent", "certificate", "gap %"},
                        {"boxes", "certificate", "boxes"},
                        {"certificate_seconds", "certificate", "seconds"}},
                       labels);
}

std::vector<Cell> certificate_row(const RecordedRun& run) {
  const SolveCells solve(run);
  std::vector<Cell> cells = opening_cells(run);
  const bool known = has_result(run), certified = known && run.record->bound.has_value();
  cells.push_back(known ? Cell(run.record->domain) : Cell::none());
  cells.push_back(known ? Cell(fmt::format("{}", run.record->rays)) : Cell::none());
  cells.insert(cells.end(), {termination_text(run), solve.seconds, solve.objective});
  if (!certified) {
    cells.insert(cells.end(), 5, Cell::none());
    return cells;
  }
  const RecordSummary& r = *run.record;
  cells.insert(cells.end(),
               {r.certificate_kind, Cell::of(*r.bound, "{:.6g}"), gap_cell(run),
                fmt::format("{}", r.certificate_boxes), Cell::of(r.certificate_seconds, "{:.3f}")});
  return cells;
}

}  // namespace

Tables certificate_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Sheet sheet =
      empty_sheet(std::ranges::any_of(runs, [](const auto& run) { return !run.run.label.empty(); }));
  std::string notes;
  for (const RecordedRun& run : runs) {
    sheet.add(certificate_row(run));
    notes += note_of(run);
  }
  Tables tables{{{"", std::move(sheet), notes}}, "f: objective; bound: no interior of the domain has less; "};
  tables.legend += certified_legend;
  tables.legend += provenance_text(runs) + '\n';
  return tables;
}

}  // namespace kreisel::core
