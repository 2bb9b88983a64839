#include "experiment/table.hpp"

#include <fmt/format.h>

#include <system_error>

#include "experiment/data_folder.hpp"
#include "experiment/run_text.hpp"
#include "experiment/runner.hpp"
#include "experiment/speedup_table.hpp"
#include "experiment/table_parts.hpp"
#include "experiment/text_table.hpp"

namespace kreisel {
namespace {

std::optional<Published> published_of(const Experiment& experiment) {
  if (experiment.published.empty()) return std::nullopt;
  return read_published(published_file(experiment.published));
}

}  // namespace

std::vector<RecordedRun> collect(const Experiment& experiment, const std::filesystem::path& results) {
  std::vector<RecordedRun> runs;
  for (const ExperimentRun& run : experiment.runs) {
    const auto path = record_path(results, experiment.name, run.config);
    std::error_code ignored;
    RecordedRun& recorded = runs.emplace_back();
    recorded.run = run;
    if (std::filesystem::exists(path, ignored)) recorded.record = read_record(path);
  }
  return runs;
}

std::string runs_table(const std::vector<RecordedRun>& runs) {
  TextTable table({{"", "label", true},
                   {"", "model", true},
                   {"", "grid", true},
                   {"", "problem", true},
                   {"", "formulation", true},
                   {"", "solver", true},
                   {"", "variables"},
                   {"", "iterations"},
                   {"", "termination", true},
                   {"", "seconds"},
                   {"", "objective"},
                   {"", "violation"},
                   {"", "verified", true}});
  std::string errors;
  for (const RecordedRun& run : runs) {
    const RunConfig& config = run.run.config;
    std::vector<std::string> row = {run.run.label.empty() ? "-" : run.run.label,
                                    model_text(config),
                                    grid_text(run),
                                    config.problem,
                                    config.formulation,
                                    config.solver};
    if (has_result(run)) {
      const RecordSummary& r = *run.record;
      row.insert(row.end(), {fmt::format("{}", r.variables), fmt::format("{}", r.iterations), r.termination,
                             seconds_text(r), fmt::format("{:.6g}", r.objective),
                             fmt::format("{:.1e}", r.violation), r.verified_ok ? "yes" : "no"});
    } else {
      row.insert(row.end(), {"-", "-", termination_text(run), "-", "-", "-", "-"});
      if (run.record) errors += fmt::format("error: {}: {}\n", run_text(config), run.record->error);
    }
    table.add(row);
  }
  return table.text() + errors + provenance_text(runs) + '\n';
}

std::string runs_csv(const std::vector<RecordedRun>& runs) {
  std::string csv = csv_line({"label", "model", "grid", "problem", "formulation", "solver", "variables",
                              "iterations", "termination", "seconds", "seconds_half_iqr", "samples",
                              "objective", "violation", "verified", "device", "commit", "error"});
  for (const RecordedRun& run : runs) {
    const RunConfig& config = run.run.config;
    std::vector<std::string> row = {run.run.label,  model_text(config), grid_text(run),
                                    config.problem, config.formulation, config.solver};
    if (has_result(run)) {
      const RecordSummary& r = *run.record;
      row.insert(row.end(),
                 {fmt::format("{}", r.variables), fmt::format("{}", r.iterations), r.termination,
                  fmt::format("{}", r.median.solve), fmt::format("{}", half_interquartile_range(r.samples)),
                  fmt::format("{}", r.samples.size()), fmt::format("{}", r.objective),
                  fmt::format("{}", r.violation), r.verified_ok ? "yes" : "no", r.device, r.commit, ""});
    } else {
      row.insert(row.end(), {"", "", termination_text(run), "", "", "", "", "", "", "", "",
                             run.record ? run.record->error : ""});
    }
    csv += csv_line(row);
  }
  return csv;
}

std::string table_text(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  const std::string title = experiment.title + "\n\n";
  if (experiment.table == Experiment::Table::speedup)
    return title + speedup_table(runs, published_of(experiment));
  return title + runs_table(runs);
}

std::string table_csv(const Experiment& experiment, const std::vector<RecordedRun>& runs) {
  if (experiment.table == Experiment::Table::speedup) return speedup_csv(runs, published_of(experiment));
  return runs_csv(runs);
}

}  // namespace kreisel
