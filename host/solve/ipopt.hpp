// ipopt.hpp - RayRep's own solver, with its settings in reach.
#pragma once

#include "solve/solver.hpp"

namespace kreisel {

/// Interior-point solve [Waechter and Biegler 2006] in one of two forms, chosen by Ipopt's own option
/// hessian_approximation:
///
///   limited-memory  minimise f(s(x)) over x with L-BFGS, the papers' way
///   exact           the lifted form (default): the ten moments are variables too, tied by s = s(x), so the
///                   Hessian of the Lagrangian is a diagonal and one 10 x 10 block
///
/// options.own takes any option of Ipopt's, by name. Two defaults differ from Ipopt's: mumps_pivot_order is
/// AMD, and obj_scaling_factor makes f's largest derivative at the start 10.
///
/// @throws InputError  an option or value that Ipopt doesn't know
Outcome solve_with_ipopt(const Task& task, const SolverOptions& options);

/// Version of the Ipopt library, such as "3.11.9".
std::string ipopt_version();

}  // namespace kreisel
