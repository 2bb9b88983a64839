#include "experiment/published_table.hpp"

#include <fmt/format.h>

#include "experiment/run_text.hpp"
#include "experiment/table_parts.hpp"

namespace kreisel::core {
namespace {

std::optional<PublishedRow::Side> side_of(const RecordedRun& run, const PublishedRow* row) {
  if (!row) return std::nullopt;
  if (run.run.asked().formulation == "rayrep") return row->rayrep;
  if (run.run.asked().formulation == "voxel") return row->voxel;
  return std::nullopt;
}

Sheet empty_sheet(bool certified) {
  std::vector<Sheet::Column> columns = {{"label", "", "", true},
                                        {"model", "", "model", true},
                                        {"grid", "", "grid", true},
                                        {"problem", "", "problem", true},
                                        {"formulation", "", "", true},
                                        {"termination", "", ""},
                                        {"variables", "here", "variables"},
                                        {"seconds", "here", "seconds"},
                                        {"seconds_half_iqr", "", ""},
                                        {"samples", "", ""},
                                        {"iterations", "here", "iter"},
                                        {"objective", "here", "f"},
                                        {"violation", "here", "violation"},
                                        {"verified", "here", "verified", true},
                                        {"published_variables", "paper", "variables"},
                                        {"published_seconds", "paper", "seconds"},
                                        {"variables_excess_percent", "here / paper", "variables, %"},
                                        {"published_seconds_over_seconds", "here / paper", "times faster"}};
  if (certified) columns.push_back({"gap_percent", "here", "gap %"});
  return Sheet(std::move(columns));
}

}  // namespace

Tables published_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>& published) {
  Tables tables;
  const bool certified = any_certified(runs);
  for (const RecordedRun& run : runs) {
    const std::string& label = run.run.label;
    const auto same_label = [&](const Block& block) { return block.heading == label; };
    Block& block = find_or_add(tables.blocks, same_label, [&] {
      return Block{label, empty_sheet(certified), {}};
    });
    const Asked& config = run.run.asked();
    const SolveCells solve(run);
    const auto there = side_of(run, find_row(run, published));
    std::optional<double> excess, faster;
    if (there && has_result(run))
      excess = (static_cast<double>(run.record->variables) / there->variables - 1) * 100;
    if (there && is_converged(run) && run.record->median.solve > 0)
      faster = there->seconds / run.record->median.solve;
    Cell seconds = solve.seconds;
    if (run.record && !is_optimal(run)) seconds.text += " !";
    std::vector<Cell> cells = {label,
                               model_text(config),
                               grid_text(run),
                               config.problem,
                               config.formulation,
                               termination_text(run),
                               solve.variables,
                               seconds,
                               solve.half_iqr,
                               solve.samples,
                               solve.iterations,
                               solve.objective,
                               solve.violation,
                               solve.verified,
                               there ? fmt::format("{}", there->variables) : "",
                               there ? fmt::format("{}", there->seconds) : "",
                               Cell::of(excess, "{:+.1f}"),
                               Cell::of(faster, "{:.2f}")};
    if (certified) cells.push_back(gap_cell(run));
    block.sheet.add(std::move(cells));
    block.notes += note_of(run);
  }
  tables.legend =
      "seconds: median ± half the interquartile range of the solve, set-up excluded; f: objective; "
      "violation: "
      "the largest of the constraints;\n"
      "variables, %: our count above the paper's; times faster: paper's seconds / ours, each on its "
      "machine\n" +
      provenance_text(runs) + '\n';
  if (certified) tables.legend += certified_legend;
  tables.legend += paper_text(published);
  return tables;
}

}  // namespace kreisel::core
