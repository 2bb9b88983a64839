#include "session/sweep.hpp"

#include <limits>

#include "error.hpp"
#include "problem/turned.hpp"
#include "solve/distance_to_rows.hpp"

namespace kreisel::core {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SolverOptions options_of_sweep(const Asked& config, const SolverEntry& solver) {
  SolverOptions options = parse_solver_options(settings_of(config, "solver"));
  // A hundred-thousandth of what a verdict asks for. The last digits would cost most of the time, near
  // directions across the rays above all, where a plane turns whole rays on and off.
  SettingTexts own = settings_of(config, solver.name);
  own.try_emplace("tolerance", "1e-8");
  options.own = solver.read(own);
  return options;
}

bool bounded(const LinearConstraints& rows) {
  return rows.lower.size() > 0 && rows.lower.allFinite() && rows.upper.allFinite();
}

}  // namespace

Sweep::Sweep(const Stages& stages, const Asked& config, const Control& control)
    : stages_(stages),
      asked_(find_problem(config.problem)),
      solver_(find_solver("moment", "quadric")),
      options_(options_of_sweep(config, solver_)),
      control_(control),
      turned_(*stages.body) {}

void Sweep::turn(const Vec3& axis, const Vec3& contact) { reframe(turned_, *stages_.body, axis, contact); }

std::optional<MapAnswer> Sweep::answer(const Settings& settings) const {
  const Body& laid = *stages_.body;
  MapAnswer result;
  result.objective = result.loss = result.miss = nan;
  std::unique_ptr<Problem> posed;
  try {
    posed = asked_.make(settings, turned_);
  } catch (const InputError&) {  // a mass that it displaces in another pose, as a boat on its keel does
  }
  if (!posed || !posed->impossible().empty()) {
    result.status = MapAnswer::infeasible;
    result.impossible = true;
    return result;
  }
  const Turned problem(std::move(posed), turned_.frame.rotation * laid.frame.rotation.transpose(),
                       turned_.frame.to_body(laid.frame.origin));
  const Task task{problem, *stages_.formulation, stages_.mass, *stages_.device, control_.stop};
  const Outcome outcome = solve(solver_, task, options_);
  switch (outcome.termination) {
    case Termination::interrupted:
      return std::nullopt;
    case Termination::optimal:
    case Termination::acceptable:
      result.status = MapAnswer::feasible;
      result.objective = outcome.objective;
      result.loss = problem.pose_loss(outcome.moments);
      result.miss = 0;
      result.verdict = problem.verify(outcome.moments, laid.frame.length);
      return result;
    case Termination::infeasible:
    case Termination::failed:
      break;
  }
  if (outcome.termination == Termination::infeasible) result.status = MapAnswer::infeasible;
  if (!bounded(problem.constraints())) return result;
  const RowDistance distance = distance_to_rows(*stages_.formulation->oracle(), stages_.mass,
                                                problem.constraints(), 1e-3, 1e-7, control_.stop);
  // Below this nobody could tell; a solver that gave up may have had only its own difficulties.
  constexpr double least = 1e-6;
  if (distance.proved > least) result.status = MapAnswer::infeasible;
  result.miss = distance.attained;
  if (control_.stopped()) return std::nullopt;  // it stopped early
  return result;
}

Vec3 contact_of(const Body& body, const Vec3& axis, Through through) {
  const Vec3 lowest = lowest_point(body.mesh, axis);
  if (through == Through::lowest) return lowest;
  const Vec3 centre = body.frame.to_model(centre_of_mass(body.solid)), up = axis.normalized();
  return centre - up.dot(centre - lowest) * up;
}

}  // namespace kreisel::core
