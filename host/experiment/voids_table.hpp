// voids_table.hpp - into how many pieces the void falls, and how to get at them.
#pragma once

#include "experiment/table.hpp"

namespace kreisel::core {

/// "voids": a row a run: voids, islands and cuts of the written part, and the paper's of that model and
/// label.
[[nodiscard]] Tables voids_tables(const std::vector<RecordedRun>& runs,
                                  const std::optional<Published>& published);

}  // namespace kreisel::core
