// standing_table.hpp - how low, and how far to tilt: ways of standing side by side.
#pragma once

#include "experiment/table.hpp"

namespace kreisel::core {

/// "standing": a block a body, a row a run: height of the centre of mass of the written part, tilt at which
/// it topples, how far it is from over the base's centroid; then the paper's, for that body.
[[nodiscard]] Tables standing_tables(const std::vector<RecordedRun>& runs,
                                     const std::optional<Published>& published);

}  // namespace kreisel::core
