// published_table.hpp - each run beside what a paper prints for that body and grid. [RayRep, table 1]
#pragma once

#include <optional>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel::core {

/// A block a label, a row a run, in the order of the file. A run is joined with the published row of its
/// model, grid and problem, and there with the side of its formulation; where there is none, the paper's
/// columns are empty. "faster" is given for converged runs alone and holds two machines in one number.
[[nodiscard]] Tables published_tables(const std::vector<RecordedRun>& runs,
                                      const std::optional<Published>& published);

}  // namespace kreisel::core
