#include "run/pipeline.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

#include "error.hpp"
#include "fabricate/verify.hpp"
#include "formulation/meet_constraints.hpp"
#include "memory.hpp"
#include "problem/ray_direction.hpp"
#include "run/remedies.hpp"
#include "run/run_domain.hpp"
#include "solve/explain.hpp"
#include "solve/interrupt.hpp"
#include "stopwatch.hpp"

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

RoundingCost cost_of(const Rounded& rounded, std::size_t moved, const Task& task, const Body& body) {
  const Problem& problem = task.problem;
  RoundingCost cost;
  cost.moments = task.mass.total(moments(rounded.solid));
  cost.objective = problem.value(cost.moments);
  cost.violation = violation(problem, cost.moments);
  cost.solid_voxels = rounded.solid.count_solid();
  cost.void_voxels = rounded.solid.size() - cost.solid_voxels;
  if (body.heavy_voids()) std::swap(cost.solid_voxels, cost.void_voxels);
  cost.mended_voxels = rounded.mended;
  cost.moved_voxels = moved;
  return cost;
}

/// Removes a folder when it goes out of scope; an empty path is left alone.
struct Temporary {
  std::filesystem::path path;
  ~Temporary() {
    std::error_code ignored;
    if (!path.empty()) std::filesystem::remove_all(path, ignored);
  }
};

/// The voids of the part as it is written, opened across the model's own axes or the solid's principal ones.
Voids voids_of(const RunOutput& output, const Body& body) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(inertia_about_centre(body.solid));
  std::vector<Vec3> directions = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (int k = 0; k < 3; ++k)
    directions.emplace_back(body.frame.rotation.transpose() * principal.eigenvectors().col(k));
  return find_voids({output.outer, output.cavity}, directions);
}

std::string warning_of(const std::vector<double>& islands) {
  const bool one = islands.size() == 1;
  return fmt::format("; but {} of {:.3g} mm^3 {} loose in the voids",
                     one ? "a piece" : fmt::format("{} pieces", islands.size()),
                     std::accumulate(islands.begin(), islands.end(), 0.0), one ? "lies" : "lie");
}

Verified write_and_verify(const RunResult& r, const std::vector<MaterialPart>& parts, const Body& body,
                          const Problem& problem, const std::string& file) {
  const Temporary temporary{
      file.empty() ? std::filesystem::temp_directory_path() / fmt::format("kreisel-{}", ::getpid()) : ""};
  const std::filesystem::path path = file.empty() ? temporary.path / "part.stl" : std::filesystem::path(file);
  const WrittenPart part = verify_written(write_parts(path, parts), body, problem);

  Verified verified;
  verified.verdict = part.verdict;
  if (!r.voids.islands.empty() && body.void_density == 0)
    verified.verdict.text += warning_of(r.voids.islands);
  verified.file = file;
  verified.moments = part.moments;
  verified.materials = part.materials;
  for (WrittenMaterial& material : verified.materials) {
    verified.triangles += material.triangles;
    if (file.empty()) material.file.clear();
  }
  verified.rounding_mismatch = (part.moments - r.rounding.moments).cwiseAbs().maxCoeff();
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

/// Rounds the optimum to whole voxels.
Inside round_to_voxels(RunResult& r, const Task& task, const Body& body, bool fit) {
  Rounded rounded = task.formulation.round(r.outcome.x);
  const std::size_t moved = fit ? meet_constraints(rounded.solid, task.problem, task.mass) : 0;
  r.rounding = cost_of(rounded, moved, task, body);
  return inside_of(body, rounded.solid);
}

/// Meshes what the optimal quadric leaves. A mesh and a sum over rays sample the same shape differently; to
/// fit, what they differ by is added to what is fixed and the problem solved again, until the mesh itself
/// meets the constraints.
Inside mesh_inside(RunResult& r, const Task& task, const Body& body, const SolverEntry& solver,
                   const SolverOptions& options, bool fit) {
  // The facets stay within a few hundredths of the wall (quadric_cavity.hpp).
  const double cell = std::min(r.grid.h, r.wall / 2);
  constexpr double met = 1e-6;  // a thousandth of what a verdict asks for
  constexpr int most_corrections = 3;
  MassModel seen = task.mass;  // the mesh's moments in place of the rays'
  std::vector<double> x = r.outcome.x;
  for (int corrections = 0;; ++corrections) {
    Inside inside = inside_of(body, r.wall, Moments(x.data()), cell);
    const Moments whole = moments_of(body, inside);
    r.rounding = {};
    r.rounding.moments = whole;
    r.rounding.objective = task.problem.value(whole);
    r.rounding.violation = violation(task.problem, whole);
    r.rounding.corrections = corrections;
    if (!fit || r.rounding.violation <= met || corrections == most_corrections) return inside;
    stop_if_interrupted();
    seen.fixed += whole - seen.total(task.formulation.moments(x));
    const Outcome again = solve(solver, {task.problem, task.formulation, seen, task.device}, options);
    if (again.termination != Termination::optimal) return inside;
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
  if (config.part == Part::none && !mesh_file.empty())
    throw InputError(
        fmt::format("part = none with the mesh {}; expected no mesh, or part = written", mesh_file));
  const SolverEntry& solver = find_solver(solver_of(config), way.name);
  require_problem(solver, asked.name);
  SolverOptions options = parse_solver_options(settings_of(config, "solver"));
  options.own = settings_of(config, solver.name);
  device::Device device(config.device,
                        config.single_precision ? device::Precision::single : device::Precision::automatic);

  tell("set-up");
  const Stopwatch setup;
  BodySpec spec = config.body;
  spec.stands_upright = asked.upright;
  spec.centred = asked.centred;
  const Body body = with_rays_across_the_cut(make_body(spec, device), config);
  stop_if_interrupted();
  const std::unique_ptr<Problem> problem = asked.make(settings_of(config, "problem"), body);
  require_form(solver, *problem);
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
  r.interior_density = body.interior_density;
  r.void_density = body.void_density;
  r.length_mm = body.frame.length;
  r.mass_unit_grams = body.mass_grams();
  r.solid_mass_grams = body.axle ? body.solid[S1] * r.mass_unit_grams : r.mass_unit_grams;
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

  output.outer = body.mesh;
  if (config.part == Part::none) return output;
  tell("round, extract, verify");
  // What cannot be met at all need not be fitted.
  const bool fit = config.rounding == Rounding::fitted && r.outcome.termination != Termination::infeasible;
  const Task task{*problem, *formulation, mass, device};
  const Inside inside =
      domain.exact ? mesh_inside(r, task, body, solver, options, fit) : round_to_voxels(r, task, body, fit);
  output.cavity = to_model(body.frame, inside.voids);
  r.voids = voids_of(output, body);
  r.verified = write_and_verify(r, parts_of(body, inside), body, *problem, mesh_file);
  r.verified.void_triangles = inside.voids.triangles.size();
  r.whole_seconds = whole.seconds() - certifying;
  r.peak_bytes = peak_memory();
  return output;
}

}  // namespace kreisel
