// ipopt_settings.hpp - with which options Ipopt solves a task: the user's, then ours.
#pragma once

#include <IpIpoptApplication.hpp>
#include <map>
#include <string>
#include <vector>

#include "solve/nlp.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {

/// Options by name, of which Ipopt knows the type.
struct IpoptSettings : SettingTexts {
  using SettingTexts::SettingTexts;
};

/// Whether Ipopt is asked for its lifted form with exact Hessians rather than for L-BFGS.
[[nodiscard]] bool wants_exact_hessian(const Task& task, const SolverOptions& options);

/// Whether a solve starts from the multipliers of one before.
[[nodiscard]] bool goes_on(const SolverOptions& options);

/// All options that are set, the user's (options.own) and what we add to them; docs/rayrep.md says why.
///
/// `linear_solver` is among them: `arrow` (solve/arrow.hpp) where the systems have that shape, else `mumps`;
/// also `mumps` where the user sets an option of MUMPS'. With options.untouched, ours are left out.
///
/// @param nlp    the task as Ipopt will see it
/// @param start  where the solve starts
/// @throws InputError  options that do not go together, or an output that cannot be written
[[nodiscard]] IpoptSettings ipopt_settings(const Task& task, const SolverOptions& options, Nlp& nlp,
                                           const std::vector<double>& start);

/// @pre  ipopt_options() has read it
void set_ipopt_option(Ipopt::IpoptApplication& app, const std::string& name, const std::string& value);

}  // namespace kreisel::core
