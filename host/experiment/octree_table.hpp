// octree_table.hpp - from the model to the written part by octree: cells, seconds, memory, what is reached.
#pragma once

#include <optional>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel::core {

/// A row a run: finest cells, variables as a share of them, those along the voids, rounds, seconds of the
/// optimisation and from the model to the verified part, memory, objective at the optimum and of the rounded
/// part, and how far that is above the certified bound.
[[nodiscard]] Tables octree_tables(const std::vector<RecordedRun>& runs,
                                   const std::optional<Published>& published);

}  // namespace kreisel::core
