// experiment_run.hpp - one run of an experiment.
#pragma once

#include <concepts>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "run/run.hpp"

namespace kreisel::core {

/// What is copied often and changed seldom: copies are one until one of them is changed. A sweep's runs are
/// in its experiment, its plan and its table.
class SharedRun {
 public:
  template <class Kind = Run>
  requires(!std::same_as<std::remove_cvref_t<Kind>, SharedRun> && std::constructible_from<Run, Kind>)
      SharedRun(Kind&& run = {})
      : run_(std::make_shared<Run>(std::forward<Kind>(run))) {}

  const Run& operator*() const { return *run_; }
  operator const Run&() const { return *run_; }
  /// This one's own. Not from several threads.
  [[nodiscard]] Run& changed() {
    if (run_.use_count() > 1) run_ = std::make_shared<Run>(*run_);
    return *run_;
  }

 private:
  std::shared_ptr<Run> run_;
};

/// One run of an experiment.
struct ExperimentRun {
  SharedRun run;
  std::string label;  ///< names the group of settings it belongs to, e.g. "paper"; may be empty
  bool mesh = false;  ///< keep the printable mesh beside the record; of a solve

  // What it is known to be. @throws std::bad_variant_access  it is another
  [[nodiscard]] const Asked& asked() const;
  [[nodiscard]] Asked& asked();
  [[nodiscard]] const RunConfig& solve() const { return std::get<RunConfig>(*run); }
  [[nodiscard]] RunConfig& solve() { return std::get<RunConfig>(run.changed()); }
  [[nodiscard]] const NestConfig& nesting() const { return std::get<NestConfig>(*run); }
  [[nodiscard]] NestConfig& nesting() { return std::get<NestConfig>(run.changed()); }
};

/// What was asked of a run: a text for each field that defines it, for tables to read.
[[nodiscard]] std::map<std::string, std::string> fields_of(const ExperimentRun& run);

/// What it may take; without limits of a nesting.
[[nodiscard]] Limits limits_of(const ExperimentRun& run);

/// As run_text() of its kind, nestings with their label.
[[nodiscard]] std::string run_text(const ExperimentRun& run);

}  // namespace kreisel::core
