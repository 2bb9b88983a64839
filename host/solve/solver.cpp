#include "solve/solver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "error.hpp"
#include "parse.hpp"
#include "solve/ipopt.hpp"
#include "solve/moment.hpp"
#include "solve/plane_sweep.hpp"
#include "unknown_name.hpp"

namespace kreisel {

std::string_view to_string(Termination termination) {
  switch (termination) {
    case Termination::optimal:
      return "optimal";
    case Termination::acceptable:
      return "acceptable";
    case Termination::infeasible:
      return "infeasible";
    case Termination::interrupted:
      return "interrupted";
    case Termination::failed:
      break;
  }
  return "failed";
}

Evaluations& Evaluations::operator+=(const Evaluations& other) {
  objective += other.objective;
  gradient += other.gradient;
  constraints += other.constraints;
  jacobian += other.jacobian;
  hessian += other.hessian;
  return *this;
}

SolverOptions parse_solver_options(const std::map<std::string, std::string>& settings) {
  SolverOptions options;
  for (const auto& [name, value] : settings) {
    if (name == "start")
      options.start = parse_start(value);
    else if (name == "curvature" && (value == "convex" || value == "full"))
      options.convexify = value == "convex";
    else if (name == "reach") {
      options.reach = parse<double>(value);
      if (!options.reach || !(*options.reach > 0))
        throw InputError(fmt::format("solver.reach = {}; expected a number > 0", value));
    } else
      throw InputError(fmt::format(
          "solver.{} = {}; expected start = lower, middle or upper, curvature = convex or full, or reach = "
          "NUMBER",
          name, value));
  }
  return options;
}

const std::vector<SolverEntry>& solvers() {
  static const std::vector<SolverEntry> all = {
      {"ipopt",
       "interior point: lifted exact Hessian, or L-BFGS (ipopt.hessian_approximation=limited-memory)",
       solve_with_ipopt,
       {"voxel", "rayrep"},
       {},
       true},
      {"moment",
       "sequential quadratic programming and Newton's method in the ten moments (docs/quadric.md)",
       solve_with_moments,
       {"quadric"}},
      {"plane-sweep",
       "carves from the far side until nothing brings the centre of mass nearer: a baseline for stand",
       solve_with_plane_sweep,
       {"voxel"},
       {"stand"}},
  };
  return all;
}

const SolverEntry& find_solver(std::string_view name, std::string_view formulation) {
  const auto entry = std::ranges::find(solvers(), name, &SolverEntry::name);
  if (entry == solvers().end()) throw unknown_name("solver", name, names_of(solvers()));
  if (std::ranges::find(entry->formulations, formulation) == entry->formulations.end())
    throw InputError(fmt::format("solver '{}' does not work with formulation '{}'; it works with: {}", name,
                                 formulation, fmt::join(entry->formulations, ", ")));
  return *entry;
}

void require_problem(const SolverEntry& solver, std::string_view problem) {
  if (!solver.problems.empty() && std::ranges::find(solver.problems, problem) == solver.problems.end())
    throw InputError(fmt::format("solver '{}' does not solve '{}'; it solves: {}", solver.name, problem,
                                 fmt::join(solver.problems, ", ")));
}

void require_form(const SolverEntry& solver, const Problem& problem) {
  if (problem.auxiliary() && !solver.auxiliary)
    throw InputError(
        fmt::format("problem.form = angle does not work with solver '{}', which knows the moments alone; "
                    "expected trace, the same problem, or solver ipopt",
                    solver.name));
}

const SolverEntry& default_solver(std::string_view formulation) {
  for (const SolverEntry& entry : solvers())
    if (std::ranges::find(entry.formulations, formulation) != entry.formulations.end()) return entry;
  throw unknown_name("formulation", formulation, names_of(formulations()));
}

Outcome solve(const SolverEntry& solver, const Task& task, const SolverOptions& options) {
  Outcome outcome = solver.solve(task, options);
  SolverOptions onward = options;
  // Dinkelbach's steps are superlinear: a handful. The limit only keeps a solver that fails to converge from
  // going round in circles.
  constexpr int most_steps = 50;
  std::unique_ptr<Problem> problem = task.problem.next(outcome.moments);
  while (problem && outcome.steps < most_steps &&
         (outcome.termination == Termination::optimal || outcome.termination == Termination::acceptable)) {
    onward.from = outcome.x;
    Outcome step = solver.solve({*problem, task.formulation, task.mass, task.device}, onward);
    step.steps = outcome.steps + 1;
    step.iterations += outcome.iterations;
    step.kernel_seconds += outcome.kernel_seconds;
    step.solve_seconds += outcome.solve_seconds;
    step.evaluations += outcome.evaluations;
    step.history.insert(step.history.begin(), outcome.history.begin(), outcome.history.end());
    outcome = std::move(step);
    problem = problem->next(outcome.moments);
  }
  if (outcome.steps > 1) {
    // Judged by the problem that was asked: the last step asks for as much as there is, and is missed by what
    // the solver leaves.
    outcome.objective = task.problem.value(outcome.moments);
    outcome.violation = violation(task.problem, outcome.moments);
    outcome.message += fmt::format(", {} steps", outcome.steps);
  }
  // A margin can always be found; whether it is enough is another question. Solvers meet 1e-9.
  constexpr double met = 1e-6;
  if (task.problem.goal() == Goal::margin && outcome.violation > met &&
      (outcome.termination == Termination::optimal || outcome.termination == Termination::acceptable)) {
    outcome.termination = Termination::infeasible;
    outcome.message = fmt::format("the constraints are missed by {:.2e} at the least", outcome.violation);
  }
  return outcome;
}

}  // namespace kreisel
