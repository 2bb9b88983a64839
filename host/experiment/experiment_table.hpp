// experiment_table.hpp - an experiment's records as its tables.
#pragma once

#include <string>
#include <vector>

#include "experiment/experiment.hpp"
#include "table/recorded_run.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// The tables that the experiment names, beside the published numbers that it names. Runs that are not on
/// record and name an absent mesh file are left out, and the legend says so.
///
/// @throws InputError  published numbers or a layout that cannot be read
[[nodiscard]] Tables tables_of(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// tables_of() as aligned plain text under the title, of at most 150 columns (models and settings with long
/// names aside). Missing values are "-". Ends with a newline.
[[nodiscard]] std::string table_text(const Experiment& experiment, const std::vector<RecordedRun>& runs);

/// The same rows as CSV with a heading line; missing values are empty.
[[nodiscard]] std::string table_csv(const Experiment& experiment, const std::vector<RecordedRun>& runs);

}  // namespace kreisel::core
