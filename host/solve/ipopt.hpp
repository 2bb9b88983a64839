// ipopt.hpp - RayRep's own solver, with its settings in reach.
#pragma once

#include "solve/solver.hpp"

namespace kreisel::core {

/// Interior-point solve [Waechter and Biegler 2006] in one of two forms, chosen by Ipopt's own option
/// hessian_approximation:
///
///   limited-memory  minimise f(s(x)) over x with L-BFGS, the papers' way
///   exact           the lifted form (default): the ten moments are variables too, tied by s = s(x), so the
///                   Hessian of the Lagrangian is a diagonal and one 10 x 10 block
///
/// Those options that differ from Ipopt's own depend on whether the moments are linear in x; what was in
/// force is in Outcome::settings (docs/rayrep.md says why).
///
/// @param options  `own`: IpoptSettings
/// @throws InputError   options that do not go together, or an output that cannot be written
/// @throws MemoryError  more variables than memory can hold, or less of it than Ipopt turned out to need
Outcome solve_with_ipopt(const Task& task, const SolverOptions& options);

/// Every option that Ipopt has, with its own check of values. Its type is IpoptSettings.
[[nodiscard]] SettingTable ipopt_options();

/// Version of the Ipopt library, such as "3.11.9".
std::string ipopt_version();

}  // namespace kreisel::core
