#include "experiment/top_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"
#include "problem/spinning.hpp"

namespace kreisel::core {
namespace {

/// @param tops  any of the runs is of a problem with a least speed
Sheet empty_sheet(bool tops, bool certified) {
  const auto of_tops = [&](const char* heading) { return tops ? heading : ""; };
  std::vector<Sheet::Column> columns = {{"wall", "", "wall"},
                                        {"settings", "", "settings", true},
                                        {"termination", "", "", true},
                                        {"objective", "", "f"},
                                        {"mass_percent", "", "mass %"},
                                        {"solid_off_axis_mm", "solid", "off, mm"},
                                        {"solid_tilt_degrees", "solid", "tilt"},
                                        {"solid_height_mm", "solid", of_tops("height")},
                                        {"solid_moment_ratio", "solid", "I/I2"},
                                        {"solid_rpm", "solid", of_tops("rpm")},
                                        {"part_height_mm", "part", of_tops("height")},
                                        {"part_moment_ratio", "part", "I/I2"},
                                        {"part_rpm", "part", of_tops("rpm")},
                                        {"omega_reduction", "reduction", of_tops("ours")},
                                        {"omega_reduction_published", "reduction", of_tops("paper")},
                                        {"verified", "", "verified", true}};
  if (certified) columns.push_back({"gap_percent", "", "gap %"});
  return sheet_of_runs(std::move(columns), false);
}

bool falls(const Asked& config) { return !find_problem(config.problem).centred; }

/// What tells the rows of a block apart: how the body lies and is parted, and what its problem weighs.
std::string settings_text(const Run& run) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : describe(run)) {
    const bool of_body = name == "axis" || name == "contact" || name == "axle";
    if (of_body || name.starts_with("problem."))
      parts.push_back(fmt::format("{}={}", of_body ? name : name.substr(8), value));
  }
  return parts.empty() ? "defaults" : fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<Cell> row_of(const RecordedRun& run, const std::optional<Published>& published, bool certified) {
  const Asked& config = run.run.asked();
  const SolveCells solve(run);
  std::vector<Cell> row = opening_cells(run);
  row.insert(row.end(),
             {to_string(config.wall), settings_text(run.run.run), termination_text(run), solve.objective});
  if (has_result(run) && run.record->written[S1] > 0) {
    const RecordSummary& r = *run.record;
    const SpinState solid = spin_state(r.solid), part = spin_state(r.written);
    const auto rpm = [&](const Moments& s) {
      return falls(config) ? Cell::of(omega_min_rpm(s, r.length_mm), "{:.0f}") : Cell::none();
    };
    row.insert(
        row.end(),
        {Cell::of(100 * r.written[S1] / r.solid[S1], "{:.1f}"),
         Cell::of(solid.off_axis * r.length_mm, "{:.2f}"), Cell::of(solid.tilt_degrees, "{:.2f}"),
         Cell::of(solid.height * r.length_mm, "{:.2f}"), Cell::of(solid.moment_ratio, "{:.3f}"), rpm(r.solid),
         Cell::of(part.height * r.length_mm, "{:.2f}"), Cell::of(part.moment_ratio, "{:.3f}"), rpm(r.written),
         falls(config)
             ? Cell::of(omega_min_rpm(r.solid, r.length_mm) / omega_min_rpm(r.written, r.length_mm), "{:.2f}")
             : Cell::none()});
  } else {
    row.insert(row.end(), 10, Cell::none());
  }
  const PublishedRow* paper = find_row(run, published);
  row.push_back(paper ? Cell::of(paper->omega_reduction, "{:.2f}") : Cell::none());
  row.push_back(solve.verified);
  if (certified) row.push_back(gap_cell(run));
  return row;
}

}  // namespace

Tables top_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  const bool certified = any_certified(runs),
             tops = std::ranges::any_of(runs, [](const RecordedRun&run) { return falls(run.run.asked()); });
  Tables tables;
  for (const RecordedRun& run : runs) {
    Block& block = find_or_add(
        tables.blocks, [&](const Block& b) { return b.heading == run.run.label; },
        [&] {
          return Block{run.run.label, empty_sheet(tops, certified), ""};
        });
    block.sheet.add(row_of(run, published, certified));
    block.notes += note_of(run);
  }
  tables.legend =
      "off, tilt: of the solid's centre of mass, and of its principal axis nearest to z, from the axis; "
      "I/I2: moment about that axis over the next\n";
  if (tops)
    tables.legend +=
        "height: of the centre of mass, mm; rpm: least speed of a stable spin [SpinIt, eq. 1], none unless "
        "the "
        "moment is the largest;\n"
        "reduction: rpm of the solid, as if it were balanced, over rpm of the part as written\n";
  if (certified) tables.legend += certified_legend;
  tables.legend += provenance_text(runs) + '\n';
  if (published) tables.legend += fmt::format("paper: {}\n", published->source);
  return tables;
}

}  // namespace kreisel::core
