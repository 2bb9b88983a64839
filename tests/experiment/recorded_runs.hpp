// recorded_runs.hpp - runs with records made by hand, for the tests of tables.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel::core {

/// An optimal run of the ellipsoid on 40x26x26 by rayrep: 0.5 s, 1300 variables, 20 iterations, objective
/// 0.8.
inline RecordedRun optimal_run(std::map<std::string, std::string> settings = {}) {
  RecordedRun run;
  run.run.asked().grid.cells = {40, 26, 26};
  run.run.asked().settings = std::move(settings);
  RecordSummary& r = run.record.emplace();
  r.grid = {40, 26, 26};
  r.termination = "optimal";
  r.variables = 1300;
  r.iterations = 20;
  r.objective = 0.8;
  r.violation = 1e-10;
  r.median = {0, 0, 0.5, 0.5};
  r.samples = {r.median};
  r.verified_ok = true;
  r.device = "a device";
  r.commit = "abc1234";
  return run;
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
