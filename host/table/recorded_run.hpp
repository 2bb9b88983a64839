// recorded_run.hpp - a run of an experiment with what is on record for it, read by names.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/records_in.hpp"
#include "table/experiment_run.hpp"

namespace kreisel::core {

struct RecordedRun {
  ExperimentRun run;
  std::optional<Record> record = {};  ///< empty: it did not run yet

  /// What was asked for: a text for each field, and its label.
  [[nodiscard]] std::map<std::string, std::string> fields() const;
  /// One of them, without looking at the others; empty: there is none.
  [[nodiscard]] std::string field(const std::string& name) const;
  /// The record's file; empty where there is none.
  [[nodiscard]] std::filesystem::path path() const { return record ? record->path : std::filesystem::path(); }
  /// There is a result with numbers in it, whatever its termination.
  [[nodiscard]] bool has_result() const { return record && record->error.empty(); }
  /// "not run", "error", else the termination.
  [[nodiscard]] std::string termination() const;
  [[nodiscard]] bool is_optimal() const;
  /// Has a result that a time or an objective may be compared with. What a solve that gave up took says
  /// nothing.
  [[nodiscard]] bool is_converged() const;

  /// What the record's summary has at "seconds.solve"; null where there is nothing.
  [[nodiscard]] nlohmann::json at(std::string_view name) const;
  /// The same as a number, if it is one.
  [[nodiscard]] std::optional<double> number(std::string_view name) const;
};

/// A line that says why a run has no result or, if asked, none that is optimal. Empty where all is well.
/// @param name  what the table calls the run; empty: as run_text() does
[[nodiscard]] std::string note_of(const RecordedRun& run, bool unless_optimal = true, std::string name = {});

}  // namespace kreisel::core
