// recorded_runs.hpp - runs with records made by hand, for the tests of tables.
#pragma once

#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "experiment/experiment_table.hpp"
#include "record/nest_record.hpp"
#include "record/record.hpp"
#include "table/layout_table.hpp"
#include "table/table_kinds.hpp"

namespace kreisel::core {

/// A run of the ellipsoid on 40x26x26 by rayrep: 0.5 s, 1300 variables, 20 iterations, objective 0.8;
/// optimal.
inline RunResult optimal_result(const std::map<std::string, std::string>& settings = {}) {
  RunResult r;
  r.config.grid.cells = {40, 26, 26};
  r.config.settings = settings;
  r.body_name = "ellipsoid";
  r.grid.n = {40, 26, 26};
  r.frame.length = r.length_mm = 1;
  r.outcome.termination = Termination::optimal;
  r.variables = 1300;
  r.outcome.iterations = 20;
  r.outcome.objective = 0.8;
  r.outcome.violation = 1e-10;
  r.median = {0, 0, 0.5, 0.5};
  r.samples = {r.median};
  r.verified.verdict.ok = true;
  r.provenance.device = "a device";
  r.provenance.commit = "abc1234";
  r.provenance.load = std::numeric_limits<double>::quiet_NaN();
  return r;
}

/// What is on record for a result.
inline RecordedRun recorded(const RunResult& result, const std::string& label = "") {
  RecordedRun run;
  run.run.run = result.config;
  run.run.label = label;
  run.record = Record{"record.h5", RecordKind::run, "", to_json(result)};
  return run;
}

/// The same of a run that failed.
inline RecordedRun failed_run(const RunResult& result, const std::string& error,
                              const std::string& label = "") {
  RecordedRun run = recorded(result, label);
  Summary& summary = run.record->summary;
  nlohmann::json left;
  for (const char* kept : {"config", "device", "commit"}) left[kept] = summary.at(kept);
  summary = left;
  run.record->error = error;
  return run;
}

/// One that did not run yet.
inline RecordedRun missing_run(const RunResult& result, const std::string& label = "") {
  RecordedRun run = recorded(result, label);
  run.record.reset();
  return run;
}

/// optimal_result() with what `change` does to it.
inline RecordedRun changed_run(const std::function<void(RunResult&)>& change, const std::string& label = "") {
  RunResult result = optimal_result();
  change(result);
  return recorded(result, label);
}

/// The tables of experiments/tables/NAME.toml, or of a kind that is code.
inline Tables tables_by(const std::string& name, const std::vector<RecordedRun>& runs,
                        const std::optional<Published>& published = {}) {
  for (const TableKind& kind : table_kinds())
    if (kind.name == name) return kind.make(runs, published);
  return tables_of(find_layout(name), runs, published);
}

/// The first line that begins so, with runs of blanks as one.
inline std::string squeezed_line(const std::string& text, const std::string& beginning) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(beginning)) continue;
    std::string out;
    for (const char c : line)
      if (c != ' ' || out.empty() || out.back() != ' ') out += c;
    return out;
  }
  return "no line begins with " + beginning + " in\n" + text;
}

}  // namespace kreisel::core
