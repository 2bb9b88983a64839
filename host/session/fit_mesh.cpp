#include "session/fit_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fabricate/fit_cut.hpp"
#include "geometry/single_precision.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "mesh/solid/simplify.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

class InsideMeshes {
 public:
  InsideMeshes(SolvedRun& run, const PartOptions& options)
      : run_(run),
        options_(options),
        tolerance_(run.body().one_material() ? options.tolerance / run.result.length_mm : 0),
        spare_(tolerance_ / 8),
        // The finer against the wall, the less deeper than the wall the vertices must lie.
        mesher_(run.body(), run.result.wall, std::min(run.result.grid.h, run.result.wall / 2), spare_),
        x_(run.result.outcome.x),
        seen_(run.mass()) {}

  /// Until the mesh meets the constraints.
  MadePart fitted() {
    constexpr int most_meshes = 6;
    for (int meshes = 1;; ++meshes) {
      if (meshes == most_meshes) tolerance_ = 0;  // a mesher's own mesh runs through itself nowhere
      const Inside inside = meshed();
      weigh(inside);
      const Moments whole = counted();
      const bool plain = met();
      moved_by_ = Moments::Zero();
      const Inside moved = plain ? inside : shifted(inside);
      const bool meets = met(), as_the_mesher_leaves_it = plain && tolerance_ == 0;
      if (meets && (as_the_mesher_leaves_it || is_sound(moved))) return taken(moved);
      if (meshes == most_meshes || (!meets && !solved_again(whole))) {
        weigh(inside);
        return taken(inside);
      }
      if (meets && !mesh_where_it_was_moved()) tolerance_ /= 4;
      ++run_.result.rounding.corrections;
    }
  }

  /// Until what is printed does. That is no smooth function of the mesh: the best round is kept.
  MadePart balanced() {
    constexpr std::size_t most_rounds = 8, most_in_vain = 2;
    MadePart best;
    RoundingCost cost_of_best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t round = 0;; ++round) {
      MadePart now = fitted();
      const PrintedMoments print = options_.printed(now.parts);
      const double missed = violation(run_.problem(), print.moments);
      if (missed < least || print.met) {
        best = std::move(now);
        best.round = round;
        cost_of_best = run_.result.rounding;
        least = missed;
      }
      if (print.met || missed <= enough || round + 1 == most_rounds || round - best.round >= most_in_vain) {
        run_.result.rounding = cost_of_best;
        return best;
      }
      run_.stop_if_asked();
      beside_ = print.moments - now_;
    }
  }

  MadePart as_it_is() {
    const Inside inside = meshed();
    weigh(inside);
    return taken(inside);
  }

 private:
  static constexpr double enough = 1e-6;  ///< a thousandth of what a verdict asks for

  /// Whether nothing runs through itself, as files in single precision keep it.
  [[nodiscard]] bool is_sound(const Inside& inside) const {
    const Body& body = run_.body();
    return self_intersections(
               in_single_precision(to_model(body.frame, inside.voids), place_of(bounding_box(body.mesh))))
        .empty();
  }

  /// A cut is moved as a mesh, body units.
  [[nodiscard]] double farthest() const { return std::max(tolerance_, run_.result.grid.h / 8); }
  /// What is to meet the constraints.
  [[nodiscard]] Moments counted() const { return now_ + beside_; }
  [[nodiscard]] bool met() const { return violation(run_.problem(), counted()) <= enough; }

  [[nodiscard]] Inside meshed() const {
    run_.stop_if_asked();
    const Body& body = run_.body();
    Inside inside = inside_of(body, mesher_, q());
    if (!body.one_material()) return inside;
    if (options_.least_void > 0)
      inside.voids = without_small_shells(inside.voids, options_.least_void / std::pow(body.frame.length, 3));
    inside.voids = simplified(inside.voids, {.along = tolerance_, .against = std::min(spare_, tolerance_)},
                              [&](const Vec3& p) { return mesher_.deeper(p, run_.result.wall); });
    return inside;
  }

  /// With its cut moved until it meets the constraints, nothing can be gained, or that is too far.
  Inside shifted(const Inside& inside) {
    // A step leaves some per cent of what was missed, for areas tell of it roughly. Finishing takes long.
    const int most_steps = options_.finish ? 3 : 12;
    CutShift shift(run_.body(), inside, q(), [&](const Vec3& p) { return mesher_.deep(p); });
    Inside moved;
    for (int step = 0; step < most_steps && !met(); ++step) {
      run_.stop_if_asked();
      if (!shift.toward(run_.problem().constraints(), counted()) || shift.most() > farthest()) break;
      ++run_.result.rounding.corrections;
      moved = shift.shifted();
      moved_by_ = shift.change();
      weigh(moved);
    }
    return moved;
  }

  /// What was moved as a mesh may run through itself; meshed where it was moved to, little is left to move.
  /// Whether that is worth a try: once after each solve, and each tolerance.
  bool mesh_where_it_was_moved() {
    const bool first = !anew_ && !moved_by_.isZero(0);
    if (first)
      for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += moved_by_[static_cast<Eigen::Index>(i)];
    anew_ = first;
    return first;
  }

  /// Solves the problem again with the moments of a mesh in place of those of its rays. Whether it can be.
  bool solved_again(const Moments& of_mesh) {
    run_.stop_if_asked();
    const Task task = run_.task_with(seen_);
    seen_.fixed += of_mesh - seen_.total(task.formulation.moments(x_));
    const Outcome again = [&] {
      const StopScope left_to_the_solver({});  // nothing may be thrown through a library's
      return solve(run_.solver(), task, run_.options());
    }();
    run_.stop_if_asked();
    if (again.termination != Termination::optimal) return false;
    x_ = again.x;
    anew_ = false;
    return true;
  }

  [[nodiscard]] Moments q() const { return Moments(x_.data()); }

  /// Says in the result what a part of this inside costs.
  void weigh(const Inside& inside) {
    const Body& body = run_.body();
    if (options_.finish) {
      finished_ = made_of(body, inside, options_);
      now_ = moments_of(body, finished_.parts);
    } else {
      now_ = moments_of(body, inside);
    }
    RoundingCost& cost = run_.result.rounding;
    cost.moments = now_;
    cost.objective = run_.problem().value(now_);
    cost.violation = violation(run_.problem(), now_);
  }

  /// The part of the inside that was weighed last.
  [[nodiscard]] MadePart taken(const Inside& inside) {
    return options_.finish ? std::move(finished_) : made_of(run_.body(), inside, options_);
  }

  SolvedRun& run_;
  const PartOptions& options_;
  double tolerance_;  ///< body units
  double spare_;      ///< what a surface may be moved towards the skin
  CavityMesher mesher_;
  std::vector<double> x_;               ///< the quadric that cuts
  Moments moved_by_ = Moments::Zero();  ///< what its cut was moved by as a mesh, coefficients of a quadric
  bool anew_ = false;                   ///< whether that is in x_ already
  MassModel seen_;                      ///< the mesh's moments, or the print's, in place of the rays'
  Moments now_ = Moments::Zero();       ///< of what was weighed last
  MadePart finished_;                   ///< that, where parts are finished, which takes long
  Moments beside_ = Moments::Zero();    ///< what a print had more than its mesh
};

}  // namespace

MadePart made_of(const Body& body, Inside inside, const PartOptions& options) {
  std::vector<MaterialPart> parts = parts_of(body, inside);
  if (options.finish) parts = options.finish(parts);
  return {std::move(inside), std::move(parts)};
}

MadePart mesh_inside(SolvedRun& run, bool fit, const PartOptions& options) {
  run.result.rounding = {};
  InsideMeshes meshes(run, options);
  if (!fit) return meshes.as_it_is();
  return options.printed ? meshes.balanced() : meshes.fitted();
}

}  // namespace kreisel::core
