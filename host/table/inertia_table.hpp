// inertia_table.hpp - the inertia tensor before and after. [RayRep, s. 4]
#pragma once

#include <optional>
#include <vector>

#include "table/published.hpp"
#include "table/recorded_run.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// A block a run with the tensor about the centre of mass, axes of the body frame, of the solid, of the
/// optimum, of the part as it was written, and of the paper's body where it prints one. In g cm^2 and, so
/// that bodies of other sizes can stand beside ours, in units of each body's own Izz before; then the
/// principal moments, how far the nearest principal axis lies from z, and whether its moment is the largest.
[[nodiscard]] Tables inertia_tables(const std::vector<RecordedRun>& runs,
                                    const std::optional<Published>& published);

}  // namespace kreisel::core
