#include "run/solved_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "problem/ray_direction.hpp"
#include "run/remedies.hpp"
#include "solve/explain.hpp"
#include "solve/interrupt.hpp"

namespace kreisel {
namespace {

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

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
  const FormulationEntry& way = find_formulation(config.formulation);
  (void)domain_of(config);
  const SolverEntry& solver = find_solver(solver_of(config), way.name);
  require_problem(solver, asked.name);
  return solver;
}

SolverOptions options_of(const RunConfig& config, const SolverEntry& solver) {
  SolverOptions options = parse_solver_options(settings_of(config, "solver"));
  options.own = settings_of(config, solver.name);
  return options;
}

/// Lays the body anew where rays along its axis would run along the cut, and nobody asked for them.
Body with_rays_across_the_cut(Body body, const RunConfig& config) {
  const BodySpec& given = config.body;
  if (given.axis || given.up || given.axle.radius) return body;
  const auto axis = ray_direction(config.problem, settings_of(config, "problem"), body);
  if (!axis) return body;
  const Body made = body;
  reframe(body, made, *axis, given.contact.value_or(lowest_point(made.mesh, *axis)));
  return body;
}

Body body_of(const RunConfig& config, device::Device& device, const Progress& progress) {
  if (progress) progress("set-up");
  const BodySpec spec = find_problem(config.problem).posed(config.body);
  Body body = with_rays_across_the_cut(make_body(spec, device), config);
  stop_if_interrupted();
  return body;
}

std::unique_ptr<Problem> problem_of(const RunConfig& config, const Body& body, const SolverEntry& solver) {
  auto problem = find_problem(config.problem).make(settings_of(config, "problem"), body);
  require_form(solver, *problem);
  return problem;
}

std::unique_ptr<Formulation> formulation_of(const RunConfig& config, const RunDomain& domain,
                                            const Problem& problem, device::Device& device) {
  stop_if_interrupted();
  const auto settings = settings_of(config, "formulation");
  if (domain.exact) return make_quadric(domain.rays(), settings, device);
  return find_formulation(config.formulation).make(*domain.columns, problem.traits(), settings, device);
}

}  // namespace

SolvedRun::SolvedRun(const RunConfig& config, const Progress& progress)
    : solver_(checked_solver(config)),
      options_(options_of(config, solver_)),
      device_(config.device,
              config.single_precision ? device::Precision::single : device::Precision::automatic),
      body_(body_of(config, device_, progress)),
      problem_(problem_of(config, body_, solver_)),
      domain_(config, body_),
      mass_(hollowed(body_, domain_.interior())),
      formulation_(formulation_of(config, domain_, *problem_, device_)) {
  formulation_->warm_up();
  stop_if_interrupted();
  const double setup_seconds = setup_.seconds();
  result.config = config;
  result.config.solver = solver_.name;
  describe_run();
  repeat_solve(setup_seconds, progress);
  if (result.outcome.termination == Termination::infeasible) {
    if (progress) progress("look for what cannot be met");
    result.infeasibility = explain_infeasible(solver_, task(), options_);
    stop_if_interrupted();  // its solves stopped early, so that what they say would be wrong
    result.remedies = what_would_help(config, body_, *problem_, device_, progress);
    stop_if_interrupted();
  }
  if (config.certify > 0) {
    if (progress) progress("certify");
    const Stopwatch certificate;
    add_certificate();
    stop_if_interrupted();
    certifying_ = certificate.seconds();
  }
}

void SolvedRun::describe_run() {
  RunResult& r = result;
  r.provenance = make_provenance(device_);
  r.body_name = body_.name;
  r.repairs = body_.repairs;
  r.frame = body_.frame;
  r.axis = body_.axis;
  r.contact = body_.contact;
  r.density = body_.density;
  r.interior_density = body_.interior_density;
  r.void_density = body_.void_density;
  r.length_mm = body_.frame.length;
  r.mass_unit_grams = body_.mass_grams();
  r.solid_mass_grams = body_.axle ? body_.solid[S1] * r.mass_unit_grams : r.mass_unit_grams;
  r.solid = body_.solid;
  r.fixed = mass_.fixed;
  describe(r, domain_);
  r.solid_objective = problem_->value(body_.solid);
  r.scope = problem_->scope(mass_);
}

void SolvedRun::repeat_solve(double setup_seconds, const Progress& progress) {
  RunResult& r = result;
  const auto tell = [&](const std::string& step) {
    if (progress) progress(step);
  };
  options_.on_refinement = [&](const Refinement& round) {
    tell(fmt::format("refine: {} cells, {} of the finest, {} still to split", round.variables,
                     round.cells.finest, round.cells.coarse));
  };
  const Stopwatch budget;
  while (static_cast<int>(r.samples.size()) < r.config.repeat &&
         (r.samples.empty() || (budget.seconds() < r.config.budget_seconds && !interrupted()))) {
    tell(fmt::format("solve {} of {}", r.samples.size() + 1, r.config.repeat));
    r.outcome = solve(solver_, task(), options_);
    if (r.outcome.termination == Termination::interrupted) throw Interrupted();
    r.samples.push_back({setup_seconds, r.outcome.kernel_seconds, r.outcome.solve_seconds,
                         setup_seconds + r.outcome.solve_seconds});
  }
  options_.on_refinement = {};
  r.median = medians(r.samples);
  r.variables = formulation_->num_variables();
  r.formulation_settings = formulation_->settings();
  r.cells = formulation_->cells();
}

/// Bounds what there is to gain; and where that finds a better interior than a solver that can start
/// anywhere, has it go on from there.
void SolvedRun::add_certificate() {
  RunResult& r = result;
  r.certificate = certify(*problem_, domain_.rays(), mass_, device_, {.gap = r.config.certify});
  const double f = r.outcome.objective;
  if (formulation_->name() != "quadric" || !(r.certificate->best < f - 1e-9 * std::abs(f))) return;
  SolverOptions from_there = options_;
  from_there.from = r.certificate->best_x;
  Outcome again = solve(solver_, task(), from_there);
  if (!(again.objective < f) || again.violation > std::max(r.outcome.violation, 1e-9)) return;
  again.message += fmt::format(
      "; from the certificate's start, for the first solve ended in a local optimum of {:.6f}", f);
  again.solve_seconds += r.outcome.solve_seconds;
  again.kernel_seconds += r.outcome.kernel_seconds;
  r.outcome = std::move(again);
}

}  // namespace kreisel
