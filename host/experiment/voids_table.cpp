#include "experiment/voids_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"

namespace kreisel::core {
namespace {

Sheet voids_sheet() {
  return sheet_of_runs({{"termination", "", "termination", true},
                        {"objective", "", "f"},
                        {"verified", "", "verified", true},
                        {"voids_mm3", "here", "mm^3"},
                        {"largest_percent", "here", "largest, %"},
                        {"islands", "here", "islands"},
                        {"voids", "here", "voids"},
                        {"cuts", "here", "cuts"},
                        {"published_voids", "paper", "voids"},
                        {"published_cuts", "paper", "cuts"}});
}

bool belongs(const PublishedRow& row, const RecordedRun& run) {
  return row.voids && row.model == model_text(run.run.asked()) &&
         (row.label.empty() || row.label == run.run.label) &&
         (row.problem.empty() || row.problem == run.run.asked().problem);
}

const PublishedRow::Voids* printed_voids(const RecordedRun& run, const std::optional<Published>& published) {
  if (!published) return nullptr;
  const auto at =
      std::ranges::find_if(published->rows, [&](const PublishedRow& row) { return belongs(row, run); });
  return at == published->rows.end() ? nullptr : &*at->voids;
}

template <class Number>
Cell count(Number n) {
  return fmt::format("{}", n);
}

/// A body of the paper that no run is of: its name, what was asked of it, and the paper's figures.
std::vector<Cell> row_without_run(const PublishedRow& row) {
  const Cell problem = row.problem.empty() ? Cell::none() : Cell(row.problem);
  std::vector<Cell> cells = {row.label, row.model, Cell::none(), problem, Cell::none(), "no run"};
  cells.insert(cells.end(), 7, Cell::none());
  cells.insert(cells.end(), {count(row.voids->pieces), count(row.voids->cuts)});
  return cells;
}

}  // namespace

Tables voids_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  Sheet sheet = voids_sheet();
  std::string notes;
  for (const RecordedRun& run : runs) {
    const SolveCells solve(run);
    std::vector<Cell> cells = opening_cells(run);
    cells.insert(cells.end(), {termination_text(run), solve.objective, solve.verified});
    if (has_result(run)) {
      const RecordSummary& r = *run.record;
      const std::optional<double> largest =
          r.voids ? std::optional(100 * r.largest_void_mm3 / r.voids_mm3) : std::nullopt;
      cells.insert(cells.end(), {Cell::of(r.voids_mm3, "{:.5g}"), Cell::of(largest, "{:.2f}"),
                                 count(r.islands), count(r.voids), count(r.cuts)});
    } else {
      cells.insert(cells.end(), 5, Cell::none());
    }
    const PublishedRow::Voids* paper = printed_voids(run, published);
    cells.push_back(paper ? count(paper->pieces) : Cell::none());
    cells.push_back(paper ? count(paper->cuts) : Cell::none());
    sheet.add(std::move(cells));
    notes += note_of(run);
  }
  if (published)
    for (const PublishedRow& row : published->rows)
      if (row.voids && std::ranges::none_of(runs, [&](const RecordedRun& run) { return belongs(row, run); }))
        sheet.add(row_without_run(row));
  Tables tables{
      {{"", std::move(sheet), notes}},
      "voids: pieces of the void that hang together; largest: its share of them; islands: pieces loose in "
      "one; cuts: planes that open every void, chosen greedily, so no more than these are needed\n" +
          provenance_text(runs) + '\n'};
  tables.legend += paper_text(published);
  return tables;
}

}  // namespace kreisel::core
