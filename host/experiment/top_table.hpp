// top_table.hpp - what hollowing does for a top or a yo-yo, beside a paper. [SpinIt, s. 8, fig. 9-10]
#pragma once

#include <optional>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel::core {

/// A block a label, a row a run: of the solid and of the part as written, height of the centre of mass, Izz
/// over the next principal moment and the least speed of a stable spin [SpinIt, eq. 1]; how far the solid's
/// centre of mass and principal axis are off the axis; and the ratio of the speeds, beside the paper's.
[[nodiscard]] Tables top_tables(const std::vector<RecordedRun>& runs,
                                const std::optional<Published>& published);

}  // namespace kreisel::core
