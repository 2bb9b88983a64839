#include "run/pipeline.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include "body/mesh_moments.hpp"
#include "error.hpp"
#include "fabricate/quadric_cavity.hpp"
#include "fabricate/verify.hpp"
#include "fabricate/void_surface.hpp"
#include "formulation/meet_constraints.hpp"
#include "memory.hpp"
#include "mesh/write.hpp"
#include "run/remedies.hpp"
#include "run/run_domain.hpp"
#include "solve/explain.hpp"
#include "solve/interrupt.hpp"

namespace kreisel {
namespace {

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

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

RoundingCost cost_of(const Rounded& rounded, std::size_t moved, const MassModel& mass,
                     const Problem& problem) {
  RoundingCost cost;
  cost.moments = mass.total(moments(rounded.solid));
  cost.objective = problem.value(cost.moments);
  cost.violation = violation(problem, cost.moments);
  cost.solid_voxels = rounded.solid.count_solid();
  cost.void_voxels = rounded.solid.size() - cost.solid_voxels;
  cost.mended_voxels = rounded.mended;
  cost.moved_voxels = moved;
  return cost;
}

/// Removes a file when it goes out of scope; an empty path is left alone.
struct Temporary {
  std::filesystem::path path;
  ~Temporary() {
    std::error_code ignored;
    if (!path.empty()) std::filesystem::remove(path, ignored);
  }
};

Verified write_and_verify(const RunOutput& output, const Body& body, const Problem& problem,
                          const std::string& file) {
  const Temporary temporary{
      file.empty() ? std::filesystem::temp_directory_path() / fmt::format("kreisel-{}.stl", ::getpid()) : ""};
  const std::filesystem::path path = file.empty() ? temporary.path : std::filesystem::path(file);
  std::vector<TriangleMesh> parts = {output.outer};
  if (!output.cavity.triangles.empty()) parts.push_back(output.cavity);
  write_mesh(path, parts);
  const WrittenPart part = verify_file(path, body, problem);

  Verified verified;
  verified.verdict = part.verdict;
  verified.file = file;
  verified.moments = part.moments;
  verified.triangles = part.triangles;
  verified.void_triangles = output.cavity.triangles.size();
  verified.rounding_mismatch = (part.moments - output.result.rounding.moments).cwiseAbs().maxCoeff();
  return verified;
}

/// Bounds what there is to gain; and where that finds a better interior than a solver that can start
/// anywhere, has it go on from there.
void add_certificate(RunResult& r, const Task& task, const Rays& domain, const SolverEntry& solver,
                     SolverOptions options) {
  r.certificate = certify(task.problem, domain, task.mass, task.device, {.gap = r.config.certify});
  const double f = r.outcome.objective;
  if (task.formulation.name() != "quadric" || !(r.certificate->best < f - 1e-9 * std::abs(f))) return;
  options.from = r.certificate->best_x;
  Outcome again = solve(solver, task, options);
  if (!(again.objective < f) || again.violation > std::max(r.outcome.violation, 1e-9)) return;
  again.message += fmt::format(
      "; from the certificate's start, for the first solve ended in a local optimum of {:.6f}", f);
  again.solve_seconds += r.outcome.solve_seconds;
  again.kernel_seconds += r.outcome.kernel_seconds;
  r.outcome = std::move(again);
}

/// Rounds the optimum to whole voxels. @return  the void's surface, body units
TriangleMesh round_to_voxels(RunResult& r, const Task& task, bool fit) {
  Rounded rounded = task.formulation.round(r.outcome.x);
  const std::size_t moved = fit ? meet_constraints(rounded.solid, task.problem, task.mass) : 0;
  r.rounding = cost_of(rounded, moved, task.mass, task.problem);
  return void_surface(rounded.solid);
}

/// Meshes the void that the optimal quadric leaves. A mesh and a sum over rays sample the same shape
/// differently; to fit, what they differ by is added to what is fixed and the problem solved again, until the
/// mesh itself meets the constraints. @return  the void's surface, body units
TriangleMesh mesh_cavity(RunResult& r, const Task& task, const Body& body, const SolverEntry& solver,
                         const SolverOptions& options, bool fit) {
  // The facets stay within a few hundredths of the wall (quadric_cavity.hpp).
  const double cell = std::min(r.grid.h, r.wall / 2);
  constexpr double met = 1e-6;  // a thousandth of what a verdict asks for
  constexpr int most_corrections = 3;
  MassModel seen = task.mass;  // the mesh's moments in place of the rays'
  std::vector<double> x = r.outcome.x;
  for (int corrections = 0;; ++corrections) {
    TriangleMesh cavity = quadric_cavity(body, r.wall, Moments(x.data()), cell);
    // Its normals point into the void, so its volume counts as less than nothing.
    const Moments whole = body.solid + task.mass.contrast * reference::mesh_moments(cavity).value;
    r.rounding = {};
    r.rounding.moments = whole;
    r.rounding.objective = task.problem.value(whole);
    r.rounding.violation = violation(task.problem, whole);
    r.rounding.corrections = corrections;
    if (!fit || r.rounding.violation <= met || corrections == most_corrections) return cavity;
    stop_if_interrupted();
    seen.fixed += whole - seen.total(task.formulation.moments(x));
    const Outcome again = solve(solver, {task.problem, task.formulation, seen, task.device}, options);
    if (again.termination != Termination::optimal) return cavity;
    x = again.x;
  }
}

}  // namespace

RunOutput run(const RunConfig& config, const std::string& mesh_file, const Progress& progress) {
  const auto tell = [&](const std::string& step) {
    if (progress) progress(step);
  };
  const Stopwatch whole;
  // What needs no work is checked first, so that a typing error costs no time.
  const ProblemEntry& asked = find_problem(config.problem);
  const FormulationEntry& way = find_formulation(config.formulation);
  (void)domain_of(config);
  const SolverEntry& solver = find_solver(solver_of(config), way.name);
  SolverOptions options = parse_solver_options(settings_of(config, "solver"));
  options.own = settings_of(config, solver.name);
  device::Device device(config.device,
                        config.single_precision ? device::Precision::single : device::Precision::automatic);

  tell("set-up");
  const Stopwatch setup;
  BodySpec spec = config.body;
  spec.stands_upright = asked.upright;
  const Body body = make_body(spec, device);
  stop_if_interrupted();
  const std::unique_ptr<Problem> problem = asked.make(settings_of(config, "problem"), body);
  const RunDomain domain(config, body);
  stop_if_interrupted();
  const MassModel mass = hollowed(body, domain.interior());
  const std::unique_ptr<Formulation> formulation =
      domain.exact ? make_quadric(domain.rays(), settings_of(config, "formulation"), device)
                   : way.make(*domain.columns, problem->traits(), settings_of(config, "formulation"), device);
  formulation->warm_up();
  stop_if_interrupted();
  const double setup_seconds = setup.seconds();

  RunOutput output;
  RunResult& r = output.result;
  r.config = config;
  r.config.solver = solver.name;
  r.provenance = make_provenance(device);
  r.body_name = body.name;
  r.repairs = body.repairs;
  r.frame = body.frame;
  r.axis = body.axis;
  r.contact = body.contact;
  r.density = body.density;
  r.length_mm = body.frame.length;
  r.mass_unit_grams = r.solid_mass_grams = body.mass_grams();
  r.solid = body.solid;
  r.fixed = mass.fixed;
  describe(r, domain);
  r.solid_objective = problem->value(body.solid);
  r.scope = problem->scope(mass);
  options.on_refinement = [&](const Refinement& round) {
    tell(fmt::format("refine: {} cells, {} of the finest, {} still to split", round.variables,
                     round.cells.finest, round.cells.coarse));
  };

  const Stopwatch budget;
  while (static_cast<int>(r.samples.size()) < config.repeat &&
         (r.samples.empty() || (budget.seconds() < config.budget_seconds && !interrupted()))) {
    tell(fmt::format("solve {} of {}", r.samples.size() + 1, config.repeat));
    r.outcome = solve(solver, {*problem, *formulation, mass, device}, options);
    if (r.outcome.termination == Termination::interrupted) throw Interrupted();
    r.samples.push_back({setup_seconds, r.outcome.kernel_seconds, r.outcome.solve_seconds,
                         setup_seconds + r.outcome.solve_seconds});
  }
  r.median = medians(r.samples);
  r.variables = formulation->num_variables();
  r.formulation_settings = formulation->settings();
  r.cells = formulation->cells();
  if (r.outcome.termination == Termination::infeasible) {
    tell("look for what cannot be met");
    r.infeasibility = explain_infeasible(solver, {*problem, *formulation, mass, device}, options);
    stop_if_interrupted();  // its solves stopped early, so that what they say would be wrong
    r.remedies = what_would_help(config, body, *problem, device, progress);
    stop_if_interrupted();
  }

  const Stopwatch certificate;
  double certifying = 0;
  if (config.certify > 0) {
    tell("certify");
    add_certificate(r, {*problem, *formulation, mass, device}, domain.rays(), solver, options);
    stop_if_interrupted();
    certifying = certificate.seconds();
  }

  tell("round, extract, verify");
  // What cannot be met at all need not be fitted.
  const bool fit = config.rounding == Rounding::fitted && r.outcome.termination != Termination::infeasible;
  const Task task{*problem, *formulation, mass, device};
  output.outer = body.mesh;
  output.cavity = to_model(body.frame, domain.exact ? mesh_cavity(r, task, body, solver, options, fit)
                                                    : round_to_voxels(r, task, fit));
  r.verified = write_and_verify(output, body, *problem, mesh_file);
  r.whole_seconds = whole.seconds() - certifying;
  r.peak_bytes = peak_memory();
  return output;
}

}  // namespace kreisel
