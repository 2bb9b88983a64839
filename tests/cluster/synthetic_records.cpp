// synthetic_records.cpp - records of a whole sweep without its solves, to measure what reads them.
//
//   synthetic_records EXPERIMENT RESULTS      of solves; each formulation is solved once, the rest is copied
#include <fmt/format.h>

#include <cstdio>
#include <map>

#include "experiment/experiment.hpp"
#include "experiment/runner.hpp"
#include "record/record.hpp"

namespace {

using namespace kreisel::core;

/// A solve of that formulation as it is written, but small.
RunResult solved(const RunConfig& asked) {
  RunConfig small = asked;
  small.grid.resolution = 16;
  return run(small).result;
}

void write_all(const Experiment& experiment, const std::filesystem::path& results) {
  constexpr int nodes = 16;
  std::map<std::string, RunResult> by_formulation;
  int made = 0;
  for (const ExperimentRun& each : experiment.runs) {
    const RunConfig& asked = each.solve();
    auto known = by_formulation.find(asked.formulation);
    if (known == by_formulation.end()) known = by_formulation.emplace(asked.formulation, solved(asked)).first;
    RunResult& result = known->second;
    result.config = asked;
    result.body_name = asked.body.model;
    result.provenance.host = fmt::format("node{:02}", made % nodes);
    result.outcome.objective = 1 + 1e-6 * made;
    write_record(record_path(results, experiment.name, each), result);
    ++made;
  }
  fmt::print("{} records\n", made);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    fmt::print(stderr, "synthetic_records: {} arguments; expected EXPERIMENT RESULTS\n", count - 1);
    return 2;
  }
  try {
    write_all(read_experiment(words[1]), words[2]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "synthetic_records: {}\n", error.what());
    return 2;
  }
}
