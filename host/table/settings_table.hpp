// settings_table.hpp - what a setting gains and what it costs, body by body.
#pragma once

#include <optional>
#include <vector>

#include "table/published.hpp"
#include "table/recorded_run.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// A block for every model, grid, problem and formulation, a row a run, in the order of the file. A row is
/// named by the fields in which the runs of its block differ, "defaults" where it sets none of them; what all
/// have in common stands above the block. "time x" is relative to the first row; "above best" to the lowest
/// objective of the block. Both for converged runs alone.
[[nodiscard]] Tables settings_tables(const std::vector<RecordedRun>& runs,
                                     const std::optional<Published>& published);

/// The same by formulation: a block for every model, grid, problem and domain, rows named by formulation and
/// by what else differs. List first what the others are to be compared with.
[[nodiscard]] Tables formulations_tables(const std::vector<RecordedRun>& runs,
                                         const std::optional<Published>& published);

}  // namespace kreisel::core
