#include "experiment/octree_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"

namespace kreisel::core {
namespace {

Sheet octree_sheet() {
  return sheet_of_runs({{"voxels", "cells", "voxels"},
                        {"variables", "cells", "variables"},
                        {"variables_percent", "cells", "%"},
                        {"along_voids", "cells", "along"},
                        {"rounds", "", "rounds"},
                        {"termination", "", "termination", true},
                        {"solve_seconds", "seconds", "solve"},
                        {"whole_seconds", "seconds", "whole"},
                        {"peak_gib", "", "GiB"},
                        {"objective", "f", "optimum"},
                        {"rounded_objective", "f", "part"},
                        {"bound", "f", "bound"},
                        {"rounded_gap_percent", "part", "gap %"},
                        {"rounded_violation", "part", "violation"},
                        {"verified", "", "verified", true}});
}

/// How far the rounded part's objective lies above the certified bound, per cent of the bound.
std::optional<double> rounded_gap(const RecordSummary& r) {
  if (!r.bound || !std::isfinite(*r.bound) || *r.bound == 0) return std::nullopt;
  return (r.rounded_objective - *r.bound) / std::abs(*r.bound) * 100;
}

std::vector<Cell> octree_row(const RecordedRun& run) {
  std::vector<Cell> cells = opening_cells(run);
  const SolveCells solve(run);
  if (!has_result(run)) {
    cells.insert(cells.end(), 5, Cell::none());
    cells.emplace_back(termination_text(run));
    cells.insert(cells.end(), 9, Cell::none());
    return cells;
  }
  const RecordSummary& r = *run.record;
  constexpr double gibi = 1 << 30;
  const double share = 100.0 * static_cast<double>(r.variables) / static_cast<double>(r.interior_voxels);
  cells.insert(cells.end(),
               {fmt::format("{}", r.interior_voxels), solve.variables, Cell::of(share, "{:.2f}"),
                fmt::format("{}", r.along_voids), fmt::format("{}", r.rounds), termination_text(run),
                Cell::of(r.median.solve, "{:.2f}"), Cell::of(r.whole_seconds, "{:.1f}"),
                Cell::of(r.peak_bytes / gibi, "{:.2f}"), solve.objective,
                Cell::of(r.rounded_objective, "{:.6g}"), Cell::of(r.bound, "{:.6g}"),
                Cell::of(rounded_gap(r), "{:.3f}"), Cell::of(r.rounded_violation, "{:.1e}"), solve.verified});
  return cells;
}

}  // namespace

Tables octree_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&) {
  Sheet sheet = octree_sheet();
  std::string notes;
  for (const RecordedRun& run : runs) {
    sheet.add(octree_row(run));
    notes += note_of(run);
  }
  return {{{"", std::move(sheet), notes}},
          "%: variables of the interior voxels; along: finest cells on the voids' surface; whole: from the "
          "model to the verified part, without the certificate; gap: of the part as written. " +
              provenance_text(runs) + '\n'};
}

}  // namespace kreisel::core
