#include "deform/deform_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "body/mesh_moments.hpp"
#include "deform/cage_handles.hpp"
#include "deform/handled_cells.hpp"
#include "deform/plainer.hpp"
#include "error.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "stop.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

/// 2^level voxels along the longest side. @throws InputError  coarser than the cage's grid
int level_of(int resolution, const DeformSettings& settings) {
  const int level = std::bit_width(static_cast<unsigned>(std::max(resolution, 2)) - 1);
  if (level < settings.grid)
    throw InputError(
        fmt::format("--deform at a resolution of {}, below the {} cells of the cage's grid; expected a finer "
                    "--resolution, or deform.grid = {}",
                    resolution, 1 << settings.grid, level));
  return level;
}

/// Voxels that fill the cells of the cage's grid.
GridSpec voxels_of(const CageGrid& cage, int level, const DeformSettings& settings) {
  const int along = cage.finer << (level - settings.grid);
  GridSpec spec;
  spec.cells = {along * cage.cells[0], along * cage.cells[1], along * cage.cells[2]};
  return spec;
}

/// How much space shrinks at the most, at the vertices: by the motion of the grid's cell that each lies in.
double least_determinant(const TriangleMesh& mesh, const CageHandles& handles, const ScaledHandles& h) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& v : mesh.vertices) {
    Eigen::Matrix3d d = Eigen::Matrix3d::Identity();
    for (const HandleWeight& w : handles.at(v)) {
      const auto one = h.segment<4>(4 * static_cast<Eigen::Index>(w.handle));
      d += (one[0] * v + one.tail<3>()) * w.gradient.transpose();
      d.diagonal().array() += w.weight * one[0];
    }
    least = std::min(least, d.determinant());
  }
  return least;
}

}  // namespace

Deformation deform_cells(const Body& body, const Problem& problem, const HandledQuestion& question,
                         const DeformSettings& settings, device::Device& device, const Control& control) {
  const Stopwatch watch;
  const StopScope scope(control.stop);
  const int level = level_of(question.resolution, settings);
  const auto cage = weighted_cage(body.local, settings.level, settings.grid, control);
  const Columns domain = make_columns(body, voxels_of(cage->cage.grid(), level, settings), question.wall);
  control.tell("deform: how a surface bends");
  const std::optional<Body> plain = plainer(body);
  const CageHandles handles(cage);
  const Eigen::MatrixXd energy =
      surface_energy((plain ? *plain : body).local, handles, settings.gamma_dl, settings.gamma_dv);
  HandledCells cells(
      body, domain,
      make_formulation(question.formulation, domain, problem.traits(), question.settings, device), cage,
      energy, problem.anchor(), device);
  const MassModel mass = hollowed(body, domain.interior);
  const Task task{problem, cells, mass, device, control.stop};

  require_form(question.solver, cells);
  Deformation result;
  SolverOptions options = question.options;
  constexpr double reach = 1e-2;  // as of what is linear in the fills
  if (!options.reach) options.reach = reach;
  options.on_refinement = [&](const Refinement& round) {
    control.tell(fmt::format("deform: {} variables, f {:.4g}", round.variables, round.objective));
  };
  const Outcome outcome = solve(question.solver, task, options);
  control.stop_if_asked();
  const ScaledHandles h = cells.handles(outcome.x);
  result.joint = {outcome.objective, outcome.violation, outcome.iterations, outcome.x.size()};
  result.anchor = problem.anchor();
  result.local = cells.skin(h);
  Box spread;
  for (std::size_t v = 0; v < result.local.vertices.size(); ++v)
    spread.add(result.local.vertices[v] - body.local.vertices[v]);
  for (std::size_t v = 0; v < result.local.vertices.size(); ++v) {
    const double far = (result.local.vertices[v] - body.local.vertices[v] - spread.centre()).norm();
    if (far <= result.largest) continue;
    result.largest = far;
    result.where = body.local.vertices[v];
  }
  result.volume =
      reference::mesh_moments(result.local).value[S1] / reference::mesh_moments(body.local).value[S1];
  result.least_determinant = least_determinant(body.local, handles, h);
  control.tell("deform: look for crossings");
  result.crossings = self_intersections(result.local).size();
  constexpr double met = 1e-6;
  result.missed = outcome.violation > met ? outcome.violation : 0;
  if (result.missed == 0 && result.crossings == 0)
    result.reached =
        problem.verify(outcome.moments, body.frame.length).ok ? Reached::all : Reached::constraints;
  result.seconds = watch.seconds();
  return result;
}

}  // namespace kreisel::core
