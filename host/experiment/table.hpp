// table.hpp - an experiment's records as a table.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/experiment.hpp"
#include "record/record.hpp"

namespace kreisel {

/// A run of an experiment with what is on record for it.
struct RecordedRun {
  ExperimentRun run;
  std::optional<RecordSummary> record;  ///< empty: it did not run yet
};

/// Every run of the experiment, in the order of the file, with its record under `results`.
///
/// @throws InputError  a record that cannot be read
[[nodiscard]] std::vector<RecordedRun> collect(const Experiment& experiment,
                                               const std::filesystem::path& results);

/// The table that the experiment names, as aligned plain text of at most 150 columns (models with long names
/// aside). Missing values are "-". Ends with a newline.
///
/// @throws InputError  published numbers that cannot be read
[[nodiscard]] std::string table_text(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// The same rows as CSV with a heading line; missing values are empty.
[[nodiscard]] std::string table_csv(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// The table of any experiment: a row a run.
[[nodiscard]] std::string runs_table(const std::vector<RecordedRun>& runs);
[[nodiscard]] std::string runs_csv(const std::vector<RecordedRun>& runs);

}  // namespace kreisel
