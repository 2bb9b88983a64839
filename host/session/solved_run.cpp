#include "session/solved_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "error.hpp"
#include "session/of_deformed.hpp"
#include "session/remedies.hpp"
#include "solve/explain.hpp"
#include "statistics.hpp"

namespace kreisel::core {
namespace {

Seconds medians(const std::vector<Seconds>& samples) {
  const auto column = [&](double Seconds::*field) {
    std::vector<double> values;
    for (const Seconds& s : samples) values.push_back(s.*field);
    return median(std::move(values));
  };
  return {column(&Seconds::setup), column(&Seconds::kernels), column(&Seconds::solve),
          column(&Seconds::total)};
}

void describe(RunResult& r, const RunDomain& domain) {
  r.domain = domain.kind();
  r.interior = domain.interior();
  r.grid = domain.grid();
  r.wall = domain.wall();
  if (domain.exact) {
    r.exact_intervals = domain.exact->intervals;
    r.rays = r.exact_intervals.size();
    return;
  }
  r.intervals = domain.columns->intervals;
  r.rays = r.intervals.size();
  r.inside_voxels = domain.columns->inside_voxels;
  r.interior_voxels = domain.columns->interior_voxels;
}

/// What needs no work is checked first, so that a typing error costs no time.
const SolverEntry& checked_solver(const RunConfig& config) {
  const ProblemEntry& asked = find_problem(config.problem);
  const SolverEntry& solver = find_solver(solver_of(config), find_formulation(config.formulation).name);
  require_problem(solver, asked.name);
  return solver;
}

SolverOptions options_of(const RunConfig& config, const SolverEntry& solver) {
  SolverOptions options = parse_solver_options(settings_of(config, "solver"));
  options.own = solver.read(settings_of(config, solver.name));
  return options;
}

}  // namespace

SolvedRun::SolvedRun(Session& session, const RunConfig& config, const Control& control, Along rays)
    : stop_(control.stop),
      solver_(&checked_solver(config)),
      options_(options_of(config, *solver_)),
      asked_(config) {
  if (!config.deform.keep.empty() && !config.deform.wanted)
    throw InputError("--keep of a body whose shape stays; expected --deform, too");
  stages_ = session.stages(config, control, config.deform.wanted ? Along::own_axis : rays);
  if (config.deform.wanted) deform(session, control, rays);
  require_form(*solver_, *stages_.problem);
  require_form(*solver_, *stages_.formulation);
  setup_seconds_ = whole_.seconds() - stages_.opening_seconds;
  result.config = config;
  result.config.solver = solver_->name;
  describe_run(session.provenance());
}

/// The run goes on with the body that it becomes, in a session of its own.
void SolvedRun::deform(Session& session, const Control& control, Along rays) {
  const std::shared_ptr<Session::OfDeformed> found = session.deformed(asked_, stages_, control);
  result.deformation = found->body.report;
  asked_ = found->body.question(std::move(asked_));
  if (!found->session) return;
  const double opening = stages_.opening_seconds;
  stages_ = found->session->stages(asked_, control, rays);
  stages_.opening_seconds = opening;
}

void SolvedRun::decide(const Control& control) {
  result.infeasibility = problem().impossible();
  if (!result.infeasibility.empty()) {
    result.outcome = {};
    result.outcome.termination = Termination::infeasible;
    result.outcome.message = "no interior can do it";
    result.outcome.moments = body().solid;
    result.outcome.objective = result.solid_objective;
    result.variables = stages_.formulation->num_variables();
    result.outcome.x.assign(result.variables, 0.0);
    result.samples = {{setup_seconds_, 0, 0, setup_seconds_}};
    result.median = result.samples.front();
    result.formulation_settings = stages_.formulation->settings();
    return;
  }
  repeat_solve(control);
}

void SolvedRun::explain(const Control& control) {
  if (result.outcome.termination != Termination::infeasible || !result.infeasibility.empty()) return;
  control.tell("look for what cannot be met");
  result.infeasibility =
      explain_infeasible(*solver_, task(), options_, BodyUnits{result.length_mm, result.mass_unit_grams});
  control.stop_if_asked();  // its solves stopped early, so that what they say would be wrong
}

void SolvedRun::look_for_remedies(const Control& control) {
  if (result.outcome.termination != Termination::infeasible || !problem().impossible().empty()) return;
  result.remedies = what_would_help(asked_, body(), problem(), *stages_.device, control);
  control.stop_if_asked();
}

void SolvedRun::complete(const Control& control) {
  solve(control);
  look_for_remedies(control);
  if (result.config.certify > 0) certify(control);
}

void SolvedRun::describe_run(const Provenance& provenance) {
  RunResult& r = result;
  const Body& body = this->body();
  r.provenance = provenance;
  r.body_name = body.name;
  r.repairs = body.repairs;
  r.frame = body.frame;
  r.axis = body.axis;
  r.contact = body.contact;
  r.density = body.density;
  r.interior_density = body.interior_density;
  r.void_density = body.void_density;
  r.length_mm = body.frame.length;
  r.mass_unit_grams = body.mass_grams();
  r.solid_mass_grams = body.axle ? body.solid[S1] * r.mass_unit_grams : r.mass_unit_grams;
  r.solid = body.solid;
  r.fixed = mass().fixed;
  describe(r, *stages_.domain);
  r.solid_objective = problem().value(body.solid);
  r.scope = problem().scope(mass());
}

void SolvedRun::repeat_solve(const Control& control) {
  RunResult& r = result;
  options_.on_refinement = [&](const Refinement& round) {
    control.tell(fmt::format("refine: {} cells, {} of the finest, {} still to split", round.variables,
                             round.cells.finest, round.cells.coarse));
  };
  const Stopwatch budget;
  while (static_cast<int>(r.samples.size()) < r.config.repeat &&
         (r.samples.empty() || (budget.seconds() < r.config.budget_seconds && !control.stopped()))) {
    control.tell(fmt::format("solve {} of {}", r.samples.size() + 1, r.config.repeat));
    r.outcome = core::solve(*solver_, task(), options_);
    if (r.outcome.termination == Termination::interrupted) throw Interrupted();
    r.samples.push_back({setup_seconds_, r.outcome.kernel_seconds, r.outcome.solve_seconds,
                         setup_seconds_ + r.outcome.solve_seconds});
  }
  options_.on_refinement = {};
  r.median = medians(r.samples);
  r.variables = stages_.formulation->num_variables();
  r.formulation_settings = stages_.formulation->settings();
  r.cells = stages_.formulation->cells();
}

void SolvedRun::certify(const Control& control) {
  control.tell("certify");
  const Stopwatch watch;
  RunResult& r = result;
  CertifyOptions options;
  options.gap = r.config.certify;
  options.stop = control.stop;
  r.certificate = kreisel::core::certify(problem(), stages_.domain->rays(), mass(), *stages_.device, options);
  go_on_from_the_certificate();
  control.stop_if_asked();
  certifying_ = watch.seconds();
}

void SolvedRun::go_on_from_the_certificate() {
  RunResult& r = result;
  const double f = r.outcome.objective;
  if (stages_.formulation->name() != "quadric" || !(r.certificate->best < f - 1e-9 * std::abs(f))) return;
  SolverOptions from_there = options_;
  from_there.from = r.certificate->best_x;
  Outcome again = core::solve(*solver_, task(), from_there);
  if (!(again.objective < f) || again.violation > std::max(r.outcome.violation, 1e-9)) return;
  again.message += fmt::format(
      "; from the certificate's start, for the first solve ended in a local optimum of {:.6f}", f);
  again.solve_seconds += r.outcome.solve_seconds;
  again.kernel_seconds += r.outcome.kernel_seconds;
  r.outcome = std::move(again);
}

}  // namespace kreisel::core
