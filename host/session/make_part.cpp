#include "session/make_part.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fabricate/verify.hpp"
#include "formulation/meet_constraints.hpp"
#include "memory.hpp"
#include "session/fit_mesh.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

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

std::string warning_of(const std::vector<double>& islands) {
  const bool one = islands.size() == 1;
  return fmt::format("; but {} of {:.3g} mm^3 {} loose in the voids",
                     one ? "a piece" : fmt::format("{} pieces", islands.size()),
                     std::accumulate(islands.begin(), islands.end(), 0.0), one ? "lies" : "lie");
}

std::string told_of_move(const Vec3& moved) {
  return moved.isZero(0) ? ""
                         : fmt::format(
                               "; the file is moved by {} mm, for so far from the origin the numbers of its "
                               "format are too coarse",
                               fmt::join(moved, ","));
}

Verified write_and_verify(const RunResult& r, const std::vector<MaterialPart>& parts, const Body& body,
                          const Problem& problem, const std::string& file, const PartOptions& options) {
  const WrittenPart part = options.written ? options.written(file, parts)
                           : file.empty()  ? verify_made(parts, body, problem)
                                           : verify_written(write_parts(file, parts), body, problem);

  Verified verified;
  verified.verdict = part.verdict;
  if (!r.voids.islands.empty() && body.void_density == 0)
    verified.verdict.text += warning_of(r.voids.islands);
  if (!part.materials.empty()) verified.verdict.text += told_of_move(part.materials.front().moved);
  verified.file = file;
  verified.moments =
      part.moments[S1] > 0 ? part.moments : r.rounding.moments;  // where nothing could be read again
  verified.materials = part.materials;
  for (const WrittenMaterial& material : verified.materials) verified.triangles += material.triangles;
  verified.rounding_mismatch = (part.moments - r.rounding.moments).cwiseAbs().maxCoeff();
  return verified;
}

/// Rounds the optimum to whole voxels.
MadePart round_to_voxels(SolvedRun& run, bool fit, const PartOptions& options) {
  const Task task = run.task();
  RunResult& r = run.result;
  Rounded rounded = task.formulation.round(r.outcome.x);
  const std::size_t moved = fit ? meet_constraints(rounded.solid, task.problem, task.mass) : 0;
  r.rounding = cost_of(rounded, moved, task, run.body());
  MadePart made = made_of(run.body(), inside_of(run.body(), rounded.solid), options);
  if (options.finish) r.rounding.moments = moments_of(run.body(), made.parts);
  return made;
}

}  // namespace

PartMeshes make_part(SolvedRun& run, const std::string& mesh_file, const PartOptions& options) {
  const StopScope scope(run.stop());
  RunResult& r = run.result;
  const Body& body = run.body();
  // What cannot be met at all need not be fitted.
  const bool fit = r.config.rounding == Rounding::fitted && r.outcome.termination != Termination::infeasible;
  const MadePart made = run.exact() ? mesh_inside(run, fit, options) : round_to_voxels(run, fit, options);
  PartMeshes part{body.mesh, to_model(body.frame, made.inside.voids), made.parts, made.round};
  r.voids = find_voids({part.outer, part.cavity}, cut_directions(body));
  r.verified = write_and_verify(r, made.parts, body, run.problem(), mesh_file, options);
  if (!r.verified.materials.empty()) {  // what is measured of the part is what its file holds
    const WrittenMaterial& material = r.verified.materials.front();
    const Vec3 place = made.parts.front().place;
    part.outer = as_written(material, std::move(part.outer), place);
    part.cavity = as_written(material, std::move(part.cavity), place);
  }
  r.verified.void_triangles = made.inside.voids.triangles.size();
  r.whole_seconds = run.seconds();
  r.peak_bytes = peak_memory();
  return part;
}

}  // namespace kreisel::core
