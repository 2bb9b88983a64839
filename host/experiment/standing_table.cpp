#include "experiment/standing_table.hpp"

#include <fmt/format.h>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"

namespace kreisel::core {
namespace {

Sheet standing_sheet() {
  return Sheet({{"run", "", ""},
                {"way", "", "way", true},
                {"formulation", "", "formulation", true},
                {"solver", "", "solver", true},
                {"target", "", "target", true},
                {"termination", "", "termination", true},
                {"seconds", "", "seconds"},
                {"height_percent", "centre of mass", "height, %"},
                {"off_centroid_mm", "centre of mass", "off, mm"},
                {"inside_mm", "centre of mass", "inside, mm"},
                {"tilt_degrees", "topples", "at, deg"},
                {"mass_g", "part", "g"},
                {"verified", "part", "verified", true}});
}

std::string setting(const Asked& config, const std::string& name, const char* otherwise) {
  const auto at = config.settings.find(name);
  return at == config.settings.end() ? otherwise : at->second;
}

/// The target as the command line names it, with a margin that was given.
std::string target_text(const Asked& config) {
  const std::string margin = setting(config, "problem.margin", "");
  return setting(config, "problem.target", "centre") + (margin.empty() ? "" : fmt::format(", {} mm", margin));
}

std::optional<double> value_of(const RecordSummary& r, const std::string& name, double scale = 1) {
  const auto at = r.verified_values.find(name);
  if (at == r.verified_values.end()) return std::nullopt;
  return scale * at->second;
}

std::vector<Cell> row_of(const std::string& heading, const RecordedRun& run) {
  const Asked& config = run.run.asked();
  const SolveCells solve(run);
  std::vector<Cell> cells = {heading,           run.run.label,       config.formulation,
                             solver_of(config), target_text(config), termination_text(run),
                             solve.seconds};
  if (!has_result(run)) {
    cells.insert(cells.end(), 6, Cell::none());
    return cells;
  }
  const RecordSummary& r = *run.record;
  cells.insert(cells.end(),
               {Cell::of(value_of(r, "height_share", 100), "{:.1f}"),
                Cell::of(value_of(r, "off_centroid_mm"), "{:.3f}"),
                Cell::of(value_of(r, "inside_mm"), "{:.3f}"), Cell::of(value_of(r, "tilt_degrees"), "{:.2f}"),
                Cell::of(r.written[S1] * r.mass_unit_grams, "{:.2f}"), solve.verified});
  return cells;
}

}  // namespace

Tables standing_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  Tables tables;
  for (const RecordedRun& run : runs) {
    const std::string heading = fmt::format("{} {}", model_text(run.run.asked()), grid_text(run));
    Block& block = find_or_add(
        tables.blocks, [&](const Block& b) { return b.heading == heading; },
        [&] {
          return Block{heading, standing_sheet(), {}};
        });
    block.sheet.add(row_of(heading, run));
    block.notes += note_of(run);
  }
  if (published)
    for (Block& block : tables.blocks)
      for (const PublishedRow& row : published->rows) {
        if (!row.standing || !block.heading.starts_with(row.model + " ")) continue;
        // What their sweep aims at is not said.
        std::vector<Cell> cells = {block.heading, "paper", Cell::none(), row.solver,
                                   row.solver.empty() ? Cell("centre") : Cell::none()};
        cells.insert(cells.end(), 2, Cell::none());
        cells.insert(cells.end(), {Cell::of(row.standing->height_percent, "{:g}"), Cell::none(), Cell::none(),
                                   Cell::of(row.standing->tilt_degrees, "{:g}"), Cell::none(), Cell::none()});
        block.sheet.add(std::move(cells));
      }
  tables.legend =
      "of the part as written; height: of the centre of mass over the ground, of the body's; off: from over "
      "the base's centroid; inside: from the nearest edge of the base; topples: at the least tilt over any "
      "edge of the base\n" +
      provenance_text(runs) + '\n';
  tables.legend += paper_text(published);
  return tables;
}

}  // namespace kreisel::core
