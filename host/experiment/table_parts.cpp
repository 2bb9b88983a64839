#include "experiment/table_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiment/run_text.hpp"
#include "statistics.hpp"

namespace kreisel::core {

double half_interquartile_range(const std::vector<Seconds>& samples) {
  std::vector<double> solves;
  for (const Seconds& sample : samples) solves.push_back(sample.solve);
  return solves.empty() ? 0 : half_interquartile_range(solves);
}

std::string seconds_text(const RecordSummary& record) {
  const double median = record.median.solve;
  const int digits = median < 0.01 ? 5 : median < 1 ? 3 : median < 100 ? 2 : 1;
  if (record.samples.size() < 2) return fmt::format("{:.{}f}", median, digits);
  return fmt::format("{:.{}f} ± {:.{}f}", median, digits, half_interquartile_range(record.samples), digits);
}

bool has_result(const RecordedRun& run) { return run.record && run.record->error.empty(); }

bool is_optimal(const RecordedRun& run) { return has_result(run) && run.record->termination == "optimal"; }

bool is_converged(const RecordedRun& run) {
  return is_optimal(run) || (has_result(run) && run.record->termination == "acceptable");
}

std::string termination_text(const RecordedRun& run) {
  if (!run.record) return "not run";
  return run.record->error.empty() ? run.record->termination : "error";
}

std::string grid_text(const RecordedRun& run) {
  GridSpec grid = run.run.asked().grid;
  if (!grid.cells && has_result(run)) grid.cells = run.record->grid;
  return grid_text(grid);
}

const PublishedRow* find_row(const RecordedRun& run, const std::optional<Published>& published) {
  if (!published) return nullptr;
  std::optional<std::array<int, 3>> cells = run.run.asked().grid.cells;
  if (!cells && has_result(run)) cells = run.record->grid;
  std::map<std::string, std::string> settings = run.run.asked().settings;
  for (const auto& [name, value] : find_problem(run.run.asked().problem).weights)
    settings.try_emplace("problem." + name, value);
  return published->find(model_text(run.run.asked()), cells, run.run.asked().problem, settings);
}

bool any_certified(const std::vector<RecordedRun>& runs) {
  return std::ranges::any_of(runs, [](const RecordedRun& run) { return has_result(run) && run.record->gap; });
}

Cell gap_cell(const RecordedRun& run) {
  // Infinite where nothing was proved, or where there is no interior at all.
  if (!has_result(run) || !run.record->gap || !std::isfinite(*run.record->gap)) return Cell::none();
  return Cell::of(100 * *run.record->gap, "{:.2g}");
}

std::string note_of(const RecordedRun& run, bool unless_optimal, std::string name) {
  if (!run.record || is_optimal(run)) return "";
  const RecordSummary& r = *run.record;
  if (r.error.empty() && !unless_optimal) return "";
  const std::string& words = r.error.empty() ? r.message : r.error;
  if (name.empty()) name = run_text(run.run);
  return fmt::format("! {}: {}{}{}\n", name, termination_text(run), words.empty() ? "" : " - ", words);
}

Sheet sheet_of_runs(std::vector<Sheet::Column> more, bool labels) {
  const std::vector<Sheet::Column> opening = {{"label", "", labels ? "label" : "", true},
                                              {"model", "", "model", true},
                                              {"grid", "", "grid", true},
                                              {"problem", "", "problem", true},
                                              {"formulation", "", "formulation", true}};
  more.insert(more.begin(), opening.begin(), opening.end());
  return Sheet(std::move(more));
}

std::vector<Cell> opening_cells(const RecordedRun& run) {
  const Asked& config = run.run.asked();
  return {run.run.label, model_text(config), grid_text(run), config.problem, config.formulation};
}

std::string paper_text(const std::optional<Published>& published) {
  return published ? fmt::format("paper: {}; {}\n", published->source, published->machine) : "";
}

SolveCells::SolveCells(const RecordedRun& run) {
  if (!has_result(run)) return;
  const RecordSummary& r = *run.record;
  variables = fmt::format("{}", r.variables);
  iterations = fmt::format("{}", r.iterations);
  seconds = {seconds_text(r), fmt::format("{}", r.median.solve)};
  setup = Cell::of(r.median.setup, "{:.2f}");
  half_iqr = fmt::format("{}", half_interquartile_range(r.samples));
  samples = fmt::format("{}", r.samples.size());
  objective = Cell::of(r.objective, "{:.6g}");
  violation = Cell::of(r.violation, "{:.1e}");
  if (r.has_part) verified = r.verified_ok ? "yes" : "no";
  device = r.device;
  commit = r.commit;
}

}  // namespace kreisel::core
