// maps_table.hpp - maps of orientations: how much of the sphere is feasible, and which axis is best.
#pragma once

#include <optional>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel::core {

/// A row a map, and of `float` a row a draft; the best axis, with its objective and what the verdict
/// measures, stands in the row of its draft.
[[nodiscard]] Tables maps_tables(const std::vector<RecordedRun>& runs,
                                 const std::optional<Published>& published);

}  // namespace kreisel::core
