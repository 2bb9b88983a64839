// starts_table.hpp - the table "starts": what a task takes from wherever it is started, beside a paper.
#pragma once

#include "table/published.hpp"
#include "table/recorded_run.hpp"
#include "table/sheet.hpp"

namespace kreisel::core {

/// A row a task: the runs that differ in `moment.seed` alone. How many end at the lowest objective of them,
/// to 1e-6 relative and as optimal; starts per such end; medians and ranges of iterations, evaluations and
/// seconds of the solves that converged; the worst violation and the smallest eigenvalue (docs/quadric.md,
/// section 3) at that objective.
[[nodiscard]] Tables starts_tables(const std::vector<RecordedRun>& runs,
                                   const std::optional<Published>& published);

}  // namespace kreisel::core
