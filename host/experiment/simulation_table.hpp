// simulation_table.hpp - parts and the solids they were made of, set spinning. [docs/physics.md]
#pragma once

#include <optional>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel::core {

/// A row a run that is to spin: the least speed by eq. 1 and by the spectrum, tip gliding and held, of the
/// solid and of the part as it was written; and a motion of each at one speed, a tenth above the least from
/// which the part is stable, or less where the solid's is near: how far each strays.
[[nodiscard]] Tables simulation_tables(const std::vector<RecordedRun>& runs, const std::optional<Published>&);

}  // namespace kreisel::core
