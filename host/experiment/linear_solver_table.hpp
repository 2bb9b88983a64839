// linear_solver_table.hpp - the same solves by two linear solvers.
#pragma once

#include <optional>
#include <vector>

#include "experiment/table.hpp"

namespace kreisel::core {

/// A row a body, grid, formulation and label, solved by MUMPS (`ipopt.linear_solver=mumps`) and by our own:
/// seconds, iterations, milliseconds an iteration of each, how many times faster, and how far the objectives
/// differ, relative.
[[nodiscard]] Tables linear_solver_tables(const std::vector<RecordedRun>& runs,
                                          const std::optional<Published>& published);

}  // namespace kreisel::core
