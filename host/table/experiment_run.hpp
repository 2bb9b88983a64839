// experiment_run.hpp - one run of an experiment.
#pragma once

#include <map>
#include <string>
#include <variant>

#include "run/run.hpp"

namespace kreisel::core {

/// One run of an experiment.
struct ExperimentRun {
  Run run;
  std::string label;  ///< names the group of settings it belongs to, e.g. "paper"; may be empty
  bool mesh = false;  ///< keep the printable mesh beside the record; of a solve

  // What it is known to be. @throws std::bad_variant_access  it is another
  [[nodiscard]] const Asked& asked() const;
  [[nodiscard]] Asked& asked();
  [[nodiscard]] const RunConfig& solve() const { return std::get<RunConfig>(run); }
  [[nodiscard]] RunConfig& solve() { return std::get<RunConfig>(run); }
  [[nodiscard]] const NestConfig& nesting() const { return std::get<NestConfig>(run); }
  [[nodiscard]] NestConfig& nesting() { return std::get<NestConfig>(run); }
};

/// What was asked of a run: a text for each field that defines it, for tables to read.
[[nodiscard]] std::map<std::string, std::string> fields_of(const ExperimentRun& run);

/// What it may take; without limits of a nesting.
[[nodiscard]] Limits limits_of(const ExperimentRun& run);

/// As run_text() of its kind, nestings with their label.
[[nodiscard]] std::string run_text(const ExperimentRun& run);

}  // namespace kreisel::core
