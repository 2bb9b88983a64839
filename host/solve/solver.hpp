// solver.hpp - finds the variables: what every solver takes and gives.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "body/body.hpp"
#include "formulation/formulation.hpp"
#include "problem/problem.hpp"
#include "solve/local_minimum.hpp"

namespace kreisel::core {

enum class Termination { optimal, acceptable, infeasible, failed, interrupted };

/// The name used in files and on the command line.
[[nodiscard]] std::string_view to_string(Termination termination);

/// One iteration, as the solver reports it.
struct Iterate {
  int iteration;
  double objective, violation, dual_infeasibility, barrier;
  double regularization;  ///< added to the Hessian to mend its inertia; 0 when not needed
  int line_search_trials;
};

/// How often each callback ran.
struct Evaluations {
  int objective = 0, gradient = 0, constraints = 0, jacobian = 0, hessian = 0;

  Evaluations& operator+=(const Evaluations& other);
};

/// One solve of a formulation that refines, and what it did to its cells.
struct Refinement {
  std::size_t variables = 0;
  CellCounts cells;
  double objective = 0, regulariser = 0, violation = 0;
  int iterations = 0;
  double seconds = 0;  ///< of the solve, and of making the cells of the next
};

/// What one solve leaves for the next of the same problem over other variables.
struct WarmStart {
  std::vector<double> multipliers;  ///< of all rows of the form that was solved
};

/// The full summary of a solve. Body units.
struct Outcome {
  Termination termination = Termination::failed;
  std::string message;  ///< the solver's own words
  int iterations = 0;
  std::vector<double> x;
  Moments moments = Moments::Zero();                   ///< totals, recomputed from x
  double objective = 0;                                ///< f(moments)
  double violation = 0;                                ///< largest constraint violation at `moments`
  double dual_infeasibility = 0, complementarity = 0;  ///< of the problem as it is posed, unscaled
  std::vector<double> auxiliary;                       ///< the problem's own variables (Nonlinear)
  std::vector<double> multipliers;                     ///< of the constraints, where the solver gives them
  double kernel_seconds = 0, solve_seconds = 0;        ///< the first is part of the second
  Evaluations evaluations;
  std::vector<Iterate> history;
  int steps = 1;  ///< problems solved in sequence (Problem::next); iterations and seconds are of all of them
  SettingTexts settings;                      ///< the solver's own as they were in force
  WarmStart warm;                             ///< where the solver can go on from one
  std::vector<Refinement> refinements;        ///< every round; of a formulation that refines
  std::optional<LocalMinimum> local_minimum;  ///< of a solve in the moments that converged

  [[nodiscard]] bool converged() const {
    return termination == Termination::optimal || termination == Termination::acceptable;
  }
  /// Counts what was done before.
  void add_before(const Outcome& before);
};

/// What is to be solved; all parts outlive the solve.
struct Task {
  const Problem& problem;
  Formulation& formulation;
  const MassModel& mass;
  device::Device& device;
  std::stop_token stop = {};  ///< ends the solve as interrupted

  /// The total moments of x.
  [[nodiscard]] Moments total(std::span<const double> x) const;
  /// (d total/dx)^T w for every w of `weights`, laid out as in Formulation::pull_back().
  void pull_back(std::span<const double> x, std::span<const Moments> weights, std::span<double> out) const;
};

struct SolverOptions {
  Start start = Start::middle;
  std::vector<double> from;  ///< variables to start from; empty: `start`
  WarmStart warm;            ///< with `from`; without multipliers: cold
  /// Told of each refinement, for progress on a terminal. May be empty.
  std::function<void(const Refinement&)> on_refinement;
  /// Drop the negative curvature of the moments: the model of every variable stays convex.
  bool convexify = true;
  /// Largest derivative of the scaled objective at the start, > 0; empty: what suits the formulation.
  std::optional<double> reach;
  /// Ipopt with its own defaults: no scale, tolerance, linear solver or curvature of ours.
  bool untouched = false;
  Settings own;  ///< what the solver has read of its own (SolverEntry::settings); none: its defaults
};

/// What is set under `solver.`, for whichever solves: start, curvature, reach, defaults.
[[nodiscard]] const SettingTable& solver_settings();
/// @throws InputError  another name or value
[[nodiscard]] SolverOptions parse_solver_options(const SettingTexts& settings);

struct SolverEntry {
  std::string name, summary;
  Outcome (*solve)(const Task& task, const SolverOptions& options);
  Offers needs = {};                       ///< of a formulation
  SettingTable settings = {};              ///< of its own, under its name: SolverOptions::own
  std::vector<std::string> problems = {};  ///< that it is made for; empty: all
  bool nonlinear = false;                  ///< takes problems with nonlinear rows or variables of their own
  bool moving = false;                     ///< takes formulations with variables that move the body

  /// @throws InputError  an unknown setting, or a value that does not fit
  [[nodiscard]] Settings read(const SettingTexts& given) const { return settings.read(given, name, name); }

  [[nodiscard]] bool works_with(const FormulationEntry& formulation) const {
    return formulation.offers.has(needs);
  }
};

/// Those that there are, and such as were added.
[[nodiscard]] Registry<SolverEntry>& solvers();

/// @throws InputError  unknown solver, or one that cannot work with the formulation
[[nodiscard]] const SolverEntry& find_solver(std::string_view name, std::string_view formulation);

/// @throws InputError  a solver that is not made for the problem
void require_problem(const SolverEntry& solver, std::string_view problem);
/// @throws InputError  the problem has nonlinear rows or variables of its own, and the solver takes none
void require_form(const SolverEntry& solver, const Problem& problem);
/// @throws InputError  the formulation has variables that move the body, and the solver takes none
void require_form(const SolverEntry& solver, const Formulation& formulation);

/// The first solver that works with a formulation. @throws InputError  unknown formulation
[[nodiscard]] const SolverEntry& default_solver(std::string_view formulation);

/// Solves the task, and then whatever Problem::next() asks for, each step from the variables of the one
/// before; and all of that again as long as the formulation refines its variables. Iterations, evaluations,
/// seconds and history are of all steps, the rest of the last.
[[nodiscard]] Outcome solve(const SolverEntry& solver, const Task& task, const SolverOptions& options);

}  // namespace kreisel::core
