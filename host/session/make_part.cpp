#include "session/make_part.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fabricate/fit_cut.hpp"
#include "fabricate/verify.hpp"
#include "formulation/meet_constraints.hpp"
#include "memory.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "mesh/solid/simplify.hpp"
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
                          const Problem& problem, const std::string& file) {
  const WrittenPart part = file.empty() ? verify_made(parts, body, problem)
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

/// What is inside the body, and the solids that are written.
struct MadePart {
  Inside inside;
  std::vector<MaterialPart> parts;
};

MadePart made_of(const Body& body, Inside inside, const PartOptions& options) {
  std::vector<MaterialPart> parts = parts_of(body, inside);
  if (options.finish) parts = options.finish(parts);
  return {std::move(inside), std::move(parts)};
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

/// Meshes what the optimal quadric leaves. A mesh and a sum over rays sample the same shape differently, and
/// fewer triangles do, too; to fit, the cut is moved until the mesh itself meets the constraints. Where that
/// is farther than a cut may be moved as a mesh, it is meshed again where it has to be.
class InsideMeshes {
 public:
  InsideMeshes(SolvedRun& run, const PartOptions& options)
      : run_(run),
        options_(options),
        tolerance_(run.body().one_material() ? options.tolerance / run.result.length_mm : 0),
        // The finer against the wall, the less deeper than the wall the vertices must lie.
        mesher_(run.body(), run.result.wall, std::min(run.result.grid.h, run.result.wall / 2), spare()) {}

  MadePart fitted() {
    constexpr int most_meshes = 4;
    Moments q(run_.result.outcome.x.data());
    for (int meshes = 1;; ++meshes) {
      const Inside inside = meshed(q);
      weigh(inside);
      if (met()) return made(inside);
      const Moments whole = now_;
      CutShift shift(run_.body(), inside, q, [&](const Vec3& p) { return mesher_.deep(p); });
      Inside moved = shifted(shift);
      if (met() && self_intersections(moved.voids).empty()) return made(std::move(moved));
      const Moments change = shift.anew(run_.problem().constraints(), whole);
      if (meshes == most_meshes || change.isZero(0)) {
        weigh(inside);
        return made(inside);
      }
      q += change;
      ++run_.result.rounding.corrections;
    }
  }

  MadePart as_it_is() {
    Inside inside = meshed(Moments(run_.result.outcome.x.data()));
    weigh(inside);
    return made(std::move(inside));
  }

 private:
  /// Of the tolerance, what a surface may be moved towards the skin.
  [[nodiscard]] double spare() const { return tolerance_ / 8; }
  /// A cut is moved as a mesh, body units.
  [[nodiscard]] double farthest() const { return std::max(tolerance_, run_.result.grid.h / 8); }
  [[nodiscard]] bool met() const {
    constexpr double enough = 1e-6;  // a thousandth of what a verdict asks for
    return run_.result.rounding.violation <= enough;
  }

  [[nodiscard]] Inside meshed(const Moments& q) const {
    run_.stop_if_asked();
    const Body& body = run_.body();
    Inside inside = inside_of(body, mesher_, q);
    if (!body.one_material()) return inside;
    if (options_.least_void > 0)
      inside.voids = without_small_shells(inside.voids, options_.least_void / std::pow(body.frame.length, 3));
    inside.voids = simplified(inside.voids, {.along = tolerance_, .against = spare()},
                              [&](const Vec3& p) { return mesher_.deeper(p, run_.result.wall); });
    return inside;
  }

  /// Moves the cut until the mesh meets the constraints, nothing can be gained, or it is moved too far.
  Inside shifted(CutShift& shift) {
    // A step leaves some per cent of what was missed, for areas tell of it roughly. Finishing takes long.
    const int most_steps = options_.finish ? 3 : 12;
    Inside inside;
    for (int step = 0; step < most_steps && !met(); ++step) {
      run_.stop_if_asked();
      if (!shift.toward(run_.problem().constraints(), now_) || shift.most() > farthest()) break;
      ++run_.result.rounding.corrections;
      inside = shift.shifted();
      weigh(inside);
    }
    return inside;
  }

  [[nodiscard]] MadePart made(Inside inside) const {
    return made_of(run_.body(), std::move(inside), options_);
  }

  /// Says in the result what a part of this inside costs.
  void weigh(const Inside& inside) {
    const Body& body = run_.body();
    now_ = options_.finish ? moments_of(body, made(inside).parts) : moments_of(body, inside);
    RoundingCost& cost = run_.result.rounding;
    cost.moments = now_;
    cost.objective = run_.problem().value(now_);
    cost.violation = violation(run_.problem(), now_);
  }

  SolvedRun& run_;
  const PartOptions& options_;
  double tolerance_;  ///< body units
  CavityMesher mesher_;
  Moments now_ = Moments::Zero();  ///< of what was weighed last
};

MadePart mesh_inside(SolvedRun& run, bool fit, const PartOptions& options) {
  run.result.rounding = {};
  InsideMeshes meshes(run, options);
  return fit ? meshes.fitted() : meshes.as_it_is();
}

}  // namespace

PartMeshes make_part(SolvedRun& run, const std::string& mesh_file, const PartOptions& options) {
  const StopScope scope(run.stop());
  RunResult& r = run.result;
  const Body& body = run.body();
  // What cannot be met at all need not be fitted.
  const bool fit = r.config.rounding == Rounding::fitted && r.outcome.termination != Termination::infeasible;
  const MadePart made = run.exact() ? mesh_inside(run, fit, options) : round_to_voxels(run, fit, options);
  PartMeshes part{body.mesh, to_model(body.frame, made.inside.voids), made.parts};
  r.voids = find_voids({part.outer, part.cavity}, cut_directions(body));
  r.verified = write_and_verify(r, made.parts, body, run.problem(), mesh_file);
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
