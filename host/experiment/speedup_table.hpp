// speedup_table.hpp - ray-reps against voxels, row by row, beside the paper's numbers. [RayRep, table 2]
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/published.hpp"
#include "experiment/table.hpp"

namespace kreisel::core {

/// One table a label, in the order of first appearance; one row a model and grid, in the order of the paper
/// where it has them, else of the file. Sides without a record show "-"; what is not optimal is marked "!"
/// and named below the table. A speed-up is given only where both sides ended optimal or acceptable: the time
/// of a solve that gave up says nothing.
[[nodiscard]] Tables speedup_tables(const std::vector<RecordedRun>& runs,
                                    const std::optional<Published>& published);

}  // namespace kreisel::core
