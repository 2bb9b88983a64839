#include "session/deformed.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "body/hydrostatics.hpp"
#include "deform/deform.hpp"
#include "deform/deform_cells.hpp"
#include "deform/surface_energy.hpp"
#include "error.hpp"
#include "mesh/make/refine.hpp"
#include "parse.hpp"
#include "session/solved_run.hpp"
#include "settings/field_text.hpp"
#include "stop.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

constexpr double longest_face = 0.05;  ///< of the body: longer ones bend in steps that show
constexpr double blend = 0.15;         ///< of the body, over which a motion fades in around what is kept
constexpr double extra_wall = 10;      ///< of the published way, whose wall deforms: wall a margin
constexpr double room = 0.25;          ///< of the body, that it may grow by on every side

/// Of the search: what is met with a margin there is met on finer grids. Slender bodies need more, for a flat
/// side that moves across a layer of rays takes all of it at once.
int cells_for(const TriangleMesh& mesh, int asked) {
  constexpr int usual = 64, across = 32, most = 128;
  const Vec3 sides = bounding_box(mesh).extent();
  const int slender = static_cast<int>(across * sides.maxCoeff() / sides.minCoeff());
  return std::min(std::max(asked, slender), std::clamp(slender, usual, most));
}

/// As published: fills of cells and handles in one optimisation.
bool is_joint(const RunConfig& question) {
  const Offers& offers = find_formulation(question.formulation).offers;
  return offers.voxels || offers.refinement;
}

void require_deformable(const Stages& stages, const RunConfig& question) {
  const auto refuse = [](const std::string& what, const char* expected) {
    throw InputError(fmt::format("--deform {}; expected {}", what, expected));
  };
  const bool joint = is_joint(question);
  if (!joint && !find_formulation(question.formulation).offers.oracle)
    refuse(fmt::format("of formulation {}", question.formulation), "--formulation quadric, octree or voxel");
  const BodySpec& body = question.body;
  if (body.axle.radius) refuse("of halves on an axle", "a yo-yo without --axle");
  if (body.stem.wanted()) refuse("of a body on a stem", "one without --stem and --tip");
  const Problem& problem = *stages.problem;
  if (problem.constraints().matrix.rows() == 0)
    refuse(fmt::format("for {}, which any interior does or none", problem.name()),
           "a problem that the moments decide");
  if (question.deform.within && problem.goal() == Goal::margin)
    refuse(
        fmt::format("within {}% for {} with a margin as its target", *question.deform.within, problem.name()),
        "--deform least");
  if (joint) {
    const auto only_quadric = [&](bool asked, std::string_view what) {
      if (asked)
        refuse(fmt::format("of formulation {} {}", question.formulation, what), "--formulation quadric");
    };
    only_quadric(question.deform.within.has_value(), "within a limit");
    only_quadric(!question.deform.keep.empty(), "with --keep");
    only_quadric(problem.goal() == Goal::margin, "with a margin as its target");
    only_quadric(problem.water().has_value(), "of what floats");
    only_quadric(problem.fixed_below().has_value(), "of what stands on a base");
  }
  const auto water = problem.water();
  constexpr double boat = 0.01;
  if (water && hydrostatics(stages.body->local, water->surface).dry > boat)
    refuse("of a body that keeps water out, as a boat", "one without dry space below the waterline");
}

/// @throws InputError  neither a ball nor a mesh
std::unique_ptr<Held> kept(const std::string& text, const Frame& frame, double side) {
  std::vector<double> numbers;
  for (const std::string_view part : field_text::split(text, ','))
    if (const auto number = parse<double>(part)) numbers.push_back(*number);
  if (numbers.size() == 4 && numbers[3] >= 0)
    return held_ball(frame.to_body({numbers[0], numbers[1], numbers[2]}), numbers[3] / frame.length,
                     blend * side);
  if (!numbers.empty())
    throw InputError(fmt::format("--keep {}; expected x,y,z,r in mm with r >= 0, or a mesh file", text));
  BodySpec spec;
  spec.model = text;
  Source source = load_solid(spec);
  for (Vec3& v : source.mesh.vertices) v = frame.to_body(source.millimetres * v);
  return held_inside(std::move(source.mesh), 1e-6, blend * side);
}

std::shared_ptr<const Held> held_of(const Stages& stages, const DeformSpec& spec, double side) {
  std::vector<std::unique_ptr<Held>> parts;
  for (const std::string& keep : spec.keep) parts.push_back(kept(keep, stages.body->frame, side));
  if (const auto height = stages.problem->fixed_below()) parts.push_back(held_below(*height, blend * side));
  if (parts.empty()) return nullptr;
  std::shared_ptr<const Held> held = held_together(std::move(parts));
  if (std::ranges::all_of(stages.body->local.vertices, [&](const Vec3& v) { return held->at(v).value == 0; }))
    throw InputError(fmt::format("--keep {} holds all of the body; expected something that may move",
                                 fmt::join(spec.keep, ";")));
  return held;
}

/// Displacements; where nothing is held the body as it was is laid as near as may be: displacements are up to
/// a translation then.
void lay_near(DeformationReport& report, const TriangleMesh& after, bool held) {
  Box box;
  for (std::size_t i = 0; i < after.vertices.size(); ++i)
    box.add(after.vertices[i] - report.before.vertices[i]);
  const Vec3 shift = held ? Vec3(Vec3::Zero()) : box.centre();
  for (std::size_t i = 0; i < after.vertices.size(); ++i) {
    report.before.vertices[i] += shift;
    report.displacement.push_back(after.vertices[i] - report.before.vertices[i]);
  }
}

}  // namespace

std::string DeformationReport::text() const {
  switch (reached) {
    case Reached::nothing:
      if (too_far)
        return fmt::format(
            "the least deformation found is {:.3g} mm ({:.3g} % of the longest side), more than allowed",
            largest_mm, largest_percent);
      if (crossings > 0)
        return fmt::format(
            "the deformation found would make its surface run through itself ({} pairs of triangles)",
            crossings);
      return fmt::format("no deformation was found that does it ({} steps)", history.size());
    case Reached::constraints:
    case Reached::all:
      break;
  }
  return fmt::format(
      "deformed: at most {:.3g} mm ({:.3g} % of the longest side, at {:.3g}), volume {:.4g} to {:.4g} cm^3, "
      "space shrunk to no less than {:.2f}{}",
      largest_mm, largest_percent, fmt::join(where, ","), volume_before / 1e3, volume_after / 1e3,
      least_determinant,
      reached == Reached::constraints ? "; it balances, though what else is asked was out of reach" : "");
}

namespace {

/// What a search comes to, in mm and the model's coordinates. @param body  undeformed, with its faces split
Deformed described(const Stages& stages, const RunConfig& question, const Body& body, bool held,
                   const Deformation& found) {
  const double side = bounding_box(body.local).extent().maxCoeff(), length = body.frame.length;
  Deformed result;
  DeformationReport& report = result.report;
  report.reached = found.reached;
  report.largest_mm = found.largest * length;
  report.largest_percent = 100 * found.largest / side;
  report.where = body.frame.to_model(found.where);
  report.volume_before = std::pow(length, 3) * body.solid[S1];
  report.volume_after = report.volume_before * found.volume;
  report.least_determinant = found.least_determinant;
  report.missed = found.missed;
  report.too_far = found.too_far;
  report.crossings = found.crossings;
  report.split = body.local.triangles.size() - stages.body->local.triangles.size();
  report.history = found.history;
  report.joint = found.joint;
  const DeformSettings settings = parse_deform_settings(settings_of(question, "deform"));
  report.energy = surface_energy(body.local, found.local.vertices, settings.gamma_dl, settings.gamma_dv);
  report.before = to_model(body.frame, body.local);
  const TriangleMesh after = to_model(body.frame, found.local);
  lay_near(report, after, held);

  result.axis = body.axis;
  result.contact = body.frame.to_model(found.anchor - stages.problem->anchor());
  result.wall = {stages.domain->wall() * length, Wall::millimetres, question.wall.to_corners};
  if (question.settings.contains("problem.point"))
    result.settings["problem.point"] = field_text::text_of(body.frame.to_model(found.anchor));
  if (const auto water = stages.problem->water())
    result.settings["problem.draft"] =
        fmt::format("{:.17g}mm", (water->surface - bounding_box(found.local).lo[2]) * length);
  if (found.reached == Reached::nothing) return result;
  auto solid = std::make_shared<Source>();
  solid->name = body.name;
  solid->format = "deformed";
  solid->mesh = after;
  solid->ours = true;
  solid->axis = body.usual.axis;
  solid->up = body.usual.up;
  solid->repairs = body.repairs;
  result.solid = std::move(solid);
  return result;
}

/// Whether what was reached on the search's grid is reached on the one that was asked for, too.
bool holds(const Deformed& deformed, const RunConfig& question, const Stages& stages,
           const Control& control) {
  Session session(deformed.solid, stages.device);
  SolvedRun run(session, deformed.question(question), Control{control.stop, {}});
  run.solve();
  const Outcome& outcome = run.result.outcome;
  return outcome.termination != Termination::infeasible &&
         (deformed.report.reached != Reached::all ||
          run.problem().verify(outcome.moments, run.result.length_mm).ok);
}

HandledQuestion handled_question(const RunConfig& question, double wall_mm) {
  const SolverEntry& solver = find_solver(solver_of(question), question.formulation);
  SolverOptions options = parse_solver_options(settings_of(question, "solver"));
  options.own = solver.read(settings_of(question, solver.name));
  return {question.formulation,     settings_of(question, "formulation"), solver, options,
          question.grid.resolution, {wall_mm, Wall::millimetres}};
}

/// Whether the cells alone do what is asked. Handles would lower the objective all the same.
bool hollowing_does(const Stages& stages, const HandledQuestion& asked, const Control& control) {
  const Task task{*stages.problem, *stages.formulation, stages.mass, *stages.device, control.stop};
  const Outcome hollowed = solve(asked.solver, task, asked.options);
  control.stop_if_asked();
  return hollowed.converged() && stages.problem->verify(hollowed.moments, stages.body->frame.length).ok;
}

Deformation as_it_is(const Stages& stages, const Body& body) {
  Deformation nothing_to_do;
  nothing_to_do.reached = Reached::all;
  nothing_to_do.local = body.local;
  nothing_to_do.anchor = stages.problem->anchor();
  return nothing_to_do;
}

}  // namespace

Deformed deformed(const Stages& stages, const RunConfig& question, const Control& control) {
  require_deformable(stages, question);
  const bool joint = is_joint(question);
  const StopScope scope(control.stop);
  const Stopwatch watch;
  Body body = *stages.body;
  const double side = bounding_box(body.local).extent().maxCoeff();
  split_edges(body.local, [most = longest_face * side](const Vec3& a, const Vec3& b) {
    return (a - b).squaredNorm() > most * most;
  });
  DeformOptions options;
  options.settings = parse_deform_settings(settings_of(question, "deform"));
  options.held = held_of(stages, question.deform, side);
  if (question.deform.within) options.within = *question.deform.within / 100 * side;
  GridSpec grid = question.grid;
  grid.cells.reset();
  grid.resolution = cells_for(body.local, question.grid.resolution);
  const double wall = stages.domain->wall() * body.frame.length;
  const std::optional<ShapeRays> rays =
      joint ? std::nullopt : std::optional(shape_rays(body, grid, {wall, Wall::millimetres}, room));
  const bool stays = joint && hollowing_does(stages, handled_question(question, wall), control);
  const auto by_cells = [&](double margin) {
    return deform_cells(body, *stages.problem, handled_question(question, wall * (1 + extra_wall * margin)),
                        options.settings, *stages.device, control);
  };
  Deformed result;
  for (const double margin :
       {5e-3, 1.5e-2, 4e-2}) {  // a coarse grid of one's own may need more than the usual
    options.margin = margin;
    const Deformation found = stays ? as_it_is(stages, body)
                              : joint
                                  ? by_cells(margin)
                                  : deform(body, *stages.problem, *rays, options, *stages.device, control);
    result = described(stages, question, body, options.held != nullptr, found);
    if (!result.solid || holds(result, question, stages, control)) break;
    result.solid.reset();
    result.report.reached = Reached::nothing;
  }
  result.report.seconds = watch.seconds();
  return result;
}

RunConfig Deformed::question(RunConfig asked) const {
  asked.deform = {};
  if (!solid) return asked;
  asked.wall = wall;
  asked.flatten = false;
  asked.body.size.reset();
  asked.body.unit.reset();
  asked.body.flatten.reset();
  asked.body.axis = axis;
  asked.body.contact = contact;
  for (const auto& [name, text] : settings) asked.settings[name] = text;
  return asked;
}

}  // namespace kreisel::core
