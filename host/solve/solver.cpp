#include "solve/solver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "error.hpp"
#include "settings/field_text.hpp"
#include "solve/ipopt.hpp"
#include "solve/moment.hpp"
#include "solve/plane_sweep.hpp"
#include "solve/slsqp.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {

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

namespace {

struct CommonSettings {
  Start start = Start::middle;
  std::optional<bool> convexify;  ///< nothing: as `untouched` says
  std::optional<double> reach;
  bool untouched = false;
};

Fields<CommonSettings> common_fields() {
  using namespace field_text;
  return {one_of<CommonSettings>(
              "start", "of the variables between their bounds: lower, middle (default) or upper",
              {"lower", "middle", "upper"}, [](auto& s) -> auto& { return s.start; }),
          one_of<CommonSettings>(
              "curvature", "of the moments in the variables: convex (default: its positive part) or full",
              {"full", "convex"}, [](auto& s) -> auto& { return s.convexify; }),
          {"reach", "",
           "largest derivative of the scaled objective at the start; default as suits the formulation",
           [](auto& s, auto k, auto v) { s.reach = positive(k, v); },
           [](auto& s) { return number_text(s.reach); }},
          one_of<CommonSettings>(
              "defaults", "of Ipopt's options: kreisel (default) or ipopt, its own", {"kreisel", "ipopt"},
              [](auto& s) -> auto& { return s.untouched; })};
}

}  // namespace

const SettingTable& solver_settings() {
  static const SettingTable all(common_fields());
  return all;
}

SolverOptions parse_solver_options(const SettingTexts& settings) {
  const auto given = settings_as<CommonSettings>(solver_settings().read(settings, "solver", "solvers"));
  SolverOptions options;
  options.start = given.start;
  options.convexify = given.convexify.value_or(!given.untouched);
  options.reach = given.reach;
  options.untouched = given.untouched;
  return options;
}

Moments Task::total(std::span<const double> x) const {
  return mass.total(formulation.moments(x)) + formulation.moved(x);
}

void Task::pull_back(std::span<const double> x, std::span<const Moments> weights,
                     std::span<double> out) const {
  std::vector<Moments> of_domain(weights.begin(), weights.end());
  for (Moments& w : of_domain) w *= mass.contrast;
  formulation.pull_back(x, of_domain, out);
  formulation.add_moved(x, weights, out);
}

namespace {

std::vector<SolverEntry> ours() {
  return {
      {"ipopt",
       "interior point: lifted exact Hessian, or L-BFGS (ipopt.hessian_approximation=limited-memory); "
       "its "
       "linear systems by our own arrow, or MUMPS (ipopt.linear_solver)",
       solve_with_ipopt,
       {.derivatives = true},
       ipopt_options(),
       {},
       true,
       true},
      {"moment",
       "sequential quadratic programming and Newton's method in the ten moments (docs/quadric.md)",
       solve_with_moments,
       {.oracle = true},
       moment_fields()},
      {"slsqp",
       "sequential least squares by NLopt, for small octrees: its memory grows with their square",
       solve_with_slsqp,
       {.derivatives = true, .refinement = true},
       slsqp_fields()},
      {"plane-sweep",
       "carves from the far side until nothing brings the centre of mass nearer: a baseline for stand",
       solve_with_plane_sweep,
       {.voxels = true},
       {},
       {"stand"}},
  };
}

}  // namespace

Registry<SolverEntry>& solvers() {
  static Registry<SolverEntry> all("solver", ours());
  return all;
}

const SolverEntry& find_solver(std::string_view name, std::string_view formulation) {
  const SolverEntry& solver = solvers().find(name);
  if (solver.works_with(find_formulation(formulation))) return solver;
  std::vector<std::string_view> names;
  for (const FormulationEntry& entry : formulations())
    if (solver.works_with(entry)) names.push_back(entry.name);
  throw InputError(fmt::format("solver '{}' does not work with formulation '{}'; it works with: {}", name,
                               formulation, fmt::join(names, ", ")));
}

void require_problem(const SolverEntry& solver, std::string_view problem) {
  if (!solver.problems.empty() && std::ranges::find(solver.problems, problem) == solver.problems.end())
    throw InputError(fmt::format("solver '{}' does not solve '{}'; it solves: {}", solver.name, problem,
                                 fmt::join(solver.problems, ", ")));
}

namespace {

/// @param asked  what the solver cannot take  @param takes  which solvers can
InputError wants_another_solver(const SolverEntry& solver, std::string_view asked, bool SolverEntry::*takes) {
  std::vector<std::string_view> names;
  for (const SolverEntry& entry : solvers())
    if (entry.*takes) names.push_back(entry.name);
  return InputError(fmt::format("{} does not work with solver '{}'; expected solver {}", asked, solver.name,
                                fmt::join(names, " or ")));
}

}  // namespace

void require_form(const SolverEntry& solver, const Problem& problem) {
  if (problem.nonlinear() && !solver.nonlinear)
    throw wants_another_solver(solver, problem.nonlinear()->asked_by(), &SolverEntry::nonlinear);
}

void require_form(const SolverEntry& solver, const Formulation& formulation) {
  if (formulation.moving() > 0 && !solver.moving)
    throw wants_another_solver(solver,
                               fmt::format("formulation '{}', which moves the body,", formulation.name()),
                               &SolverEntry::moving);
}

const SolverEntry& default_solver(std::string_view formulation) {
  const FormulationEntry& asked = find_formulation(formulation);
  for (const SolverEntry& entry : solvers())
    if (entry.works_with(asked)) return entry;
  throw InputError(fmt::format("no solver works with formulation '{}'; expected one that does", formulation));
}

void Outcome::add_before(const Outcome& before) {
  iterations += before.iterations;
  kernel_seconds += before.kernel_seconds;
  solve_seconds += before.solve_seconds;
  evaluations += before.evaluations;
  history.insert(history.begin(), before.history.begin(), before.history.end());
}

namespace {

Outcome solve_sequence(const SolverEntry& solver, const Task& task, const SolverOptions& options) {
  Outcome outcome = solver.solve(task, options);
  SolverOptions onward = options;
  onward.warm = {};
  // Dinkelbach's steps are superlinear: a handful. The limit only keeps a solver that fails to converge from
  // going round in circles.
  constexpr int most_steps = 50;
  std::unique_ptr<Problem> problem = task.problem.next(outcome.moments);
  while (problem && outcome.steps < most_steps && outcome.converged()) {
    onward.from = outcome.x;
    Outcome step = solver.solve({*problem, task.formulation, task.mass, task.device, task.stop}, onward);
    step.steps = outcome.steps + 1;
    step.add_before(outcome);
    outcome = std::move(step);
    problem = problem->next(outcome.moments);
  }
  if (outcome.steps > 1) {
    // Judged by the problem that was asked: the last step asks for as much as there is, and is missed by what
    // the solver leaves.
    outcome.objective = task.problem.value(outcome.moments);
    outcome.violation = violation(task.problem, outcome.moments);
    outcome.message += fmt::format(", {} steps", outcome.steps);
    outcome.warm = {};  // of another problem
  }
  // A margin can always be found; whether it is enough is another question. Solvers meet 1e-9.
  constexpr double not_met = 1e-6;
  if (task.problem.goal() == Goal::margin && outcome.violation > not_met && outcome.converged()) {
    outcome.termination = Termination::infeasible;
    outcome.message = fmt::format("the constraints are missed by {:.2e} at the least", outcome.violation);
  }
  return outcome;
}

Refinement describe(const Task& task, const Outcome& outcome) {
  const SparseForm* regulariser = task.formulation.regulariser();
  return {outcome.x.size(),     task.formulation.count_cells(outcome.x),
          outcome.objective,    regulariser ? regulariser->value(outcome.x) : 0.0,
          outcome.violation,    outcome.iterations,
          outcome.solve_seconds};
}

/// Is there anything to learn from finer cells? What coarse ones cannot meet, finer ones may: those are
/// sought along the best compromise, while they are few. It takes a solver long to say of many that they
/// cannot.
bool worth_refining(const Outcome& outcome) {
  constexpr std::size_t few = 20'000;
  return outcome.converged() || (outcome.termination == Termination::infeasible && outcome.x.size() <= few);
}

}  // namespace

Outcome solve(const SolverEntry& solver, const Task& task, const SolverOptions& options) {
  task.formulation.restart();
  Outcome all = solve_sequence(solver, task, options);
  SolverOptions onward = options;
  Refinement round = describe(task, all);
  // A level a round, and some more where the void's surface moves on to cells that were left coarse.
  constexpr std::size_t most_rounds = 16;
  while (task.formulation.refines()) {
    const Stopwatch watch;
    onward.from = all.x;
    onward.warm = all.warm;
    const bool refined = worth_refining(all) && all.refinements.size() + 1 < most_rounds &&
                         task.formulation.refine(onward.from);
    if (!refined) {
      all.x = onward.from;
      round.variables = all.x.size();
      round.cells = task.formulation.count_cells(all.x);
    }
    const double seconds = watch.seconds();
    round.seconds += seconds;
    all.solve_seconds += seconds;
    all.refinements.push_back(round);
    if (options.on_refinement) options.on_refinement(round);
    if (!refined) break;
    Outcome next = solve_sequence(solver, task, onward);
    if (!next.converged() && next.termination != Termination::interrupted &&
        !onward.warm.multipliers.empty()) {
      onward.warm = {};
      next = solve_sequence(solver, task, onward);
    }
    round = describe(task, next);
    next.refinements = std::move(all.refinements);
    next.add_before(all);
    all = std::move(next);
  }
  return all;
}

}  // namespace kreisel::core
