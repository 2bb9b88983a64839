#include "deform/deform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "body/mesh_moments.hpp"
#include "deform/cage_handles.hpp"
#include "deform/handles.hpp"
#include "deform/plainer.hpp"
#include "deform/separation.hpp"
#include "error.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "stop.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of the handles, and what it is worth.
struct State {
  Eigen::MatrixX3d u;
  double missed = infinity, largest = infinity;
  double falls_short = infinity;  ///< of all that it is to meet: what is left of the worst
  bool does = false;
};

struct Found {
  Reached reached = Reached::nothing;
  State state;
};

class Search {
 public:
  Search(const Body& body, const Problem& problem, const ShapeRays& rays, const DeformOptions& options,
         const Handles& handles, Separation& separation, std::vector<DeformStep>& history,
         device::Device& device, const Control& control)
      : body_(body),
        problem_(problem),
        rays_(rays),
        options_(options),
        separation_(separation),
        history_(history),
        device_(device),
        control_(control),
        move_(body.local, handles, problem.anchor(), move_options(options)) {
    here_.u = Eigen::MatrixX3d::Zero(move_.motion().handles(), 3);
  }

  [[nodiscard]] const LeastMove& move() const { return move_; }

  /// From where the body is, as little as does.
  Found find();
  /// From what does, the best objective within the limit.
  Found improve(const Found& from, double within);
  /// From what does on another mesh of the body.
  /// @param within  no vertex is displaced by more
  Found settle(const Found& from, double within);

 private:
  static MoveOptions move_options(const DeformOptions& options) {
    MoveOptions move = options.move;
    move.held = options.held != nullptr;
    return move;
  }
  /// As far as derivatives are trusted.
  [[nodiscard]] double most_of_step() const { return 0.04 * move_.longest_side(); }

  Shape shape_here();
  /// Looks at the shape here. @return  it
  Shape look(bool also);
  /// Steps towards what meets `also`, too, or not; with `polish` then towards the least that does. Leaves the
  /// best in best_.
  bool reach(bool also, bool polish);

  const Body& body_;
  const Problem& problem_;
  const ShapeRays& rays_;
  const DeformOptions& options_;
  Separation& separation_;
  std::vector<DeformStep>& history_;
  device::Device& device_;
  const Control& control_;
  LeastMove move_;

  State here_;
  std::optional<Eigen::MatrixX3d> looked_at_;  ///< handles of the last shape that there was
  HandleRows rows_;                            ///< of the quadrics, about here
  std::optional<State> best_;
};

/// Where a step leaves no interior, half of it is taken, and less.
Shape Search::shape_here() {
  constexpr int most_halves = 8;
  for (int halves = 0;; ++halves) try {
      Shape shape(body_, move_.motion().moved(here_.u), rays_, device_);
      looked_at_ = here_.u;
      return shape;
    } catch (const InputError&) {
      if (!looked_at_ || halves == most_halves) throw;
      here_.u = (here_.u + *looked_at_) / 2;
    }
}

Shape Search::look(bool also) {
  control_.stop_if_asked();
  Shape shape = shape_here();
  Separated found = separation_.look(shape, move_.motion(), here_.u, also);
  rows_ = std::move(found.rows);
  const double shrunk = options_.move.least_determinant - move_.least_determinant(here_.u);
  here_.missed = found.missed;
  here_.largest = move_.largest(here_.u);
  here_.does = found.missed == 0 && found.worst <= -options_.margin / 2 && shrunk <= 0;
  here_.falls_short = std::max({found.missed, found.worst + options_.margin / 2, 0.01 * shrunk});
  history_.push_back({found.missed, here_.largest, separation_.size()});
  control_.tell(fmt::format("deform: step {}, {}moved by {:.1f} %", history_.size(),
                            found.missed > 0 ? fmt::format("missed by {:.4f}, ", found.missed) : "",
                            100 * here_.largest / move_.longest_side()));
  return shape;
}

bool Search::reach(bool also, bool polish) {
  constexpr int most_steps = 60, most_in_vain = 12;
  constexpr double another_body = 0.4;  // of the longest side
  const double side = move_.longest_side();
  best_.reset();
  double most = most_of_step(), least_short = infinity;
  int in_vain = 0;
  for (int i = 0; i < most_steps; ++i) {
    (void)look(also);
    if (here_.does && !polish) return best_ = here_, true;
    if (here_.does && (!best_ || here_.largest < best_->largest)) {
      if (best_ && here_.largest > 0.998 * best_->largest) most /= 2;
      best_ = here_;
    } else if (best_) {
      most /= 1.5;
    } else if (here_.falls_short > least_short) {
      most = std::max(most / 1.5, most_of_step() / 16);  // it goes to and fro
    }
    in_vain = here_.falls_short > 0.95 * least_short ? in_vain + 1 : 0;
    least_short = std::min(least_short, here_.falls_short);
    if (!best_ && (in_vain > most_in_vain || here_.largest > another_body * side)) break;
    if (most < 1e-3 * side) break;
    here_.u = move_.step(here_.u, rows_, most);
  }
  return best_.has_value();
}

Found Search::find() {
  const bool more = problem_.also_asked(body_.solid).matrix.rows() > 0;
  (void)look(more);
  if (here_.does) return {Reached::all, here_};
  if (!more) {
    const bool reached = reach(false, true);
    return {reached ? Reached::all : Reached::nothing, reached ? *best_ : here_};
  }
  separation_.forget();  // some are of the rows beyond the constraints
  if (!reach(false, false)) return {Reached::nothing, here_};
  const State balanced = *best_;
  const Separation before = separation_;
  if (reach(true, true)) return {Reached::all, *best_};
  here_ = balanced;
  separation_ = before;
  return {Reached::constraints, reach(false, true) ? *best_ : balanced};
}

Found Search::improve(const Found& from, double within) {
  const bool also = from.reached == Reached::all;
  Found best = from;
  here_ = from.state;
  double most = most_of_step(), least = infinity;
  constexpr int most_steps = 30;
  std::optional<Separation::Value> value;
  HandleRows rows;  // of the best
  for (int i = 0; i < most_steps && most > 1e-3 * move_.longest_side(); ++i) {
    const Shape shape = look(also);
    const auto here = here_.does && here_.largest <= within * (1 + 1e-9)
                          ? separation_.value(shape, move_.motion())
                          : std::nullopt;
    if (here && here->value < least) {
      const bool hardly = here->value > least - 1e-3 * std::abs(least);
      if (std::isfinite(least) && hardly) most /= 2;
      least = here->value;
      best.state = here_;
      value = here;
      rows = rows_;
    } else if (value) {
      most /= 2;
      here_ = best.state;
      if (rows.size() < rows_.size()) rows = rows_;  // what was found beyond counts from now on
    } else {
      return best;  // what does has no optimum: nothing to go by
    }
    here_.u = move_.descend(here_.u, value->slope, rows, within, most);
  }
  return best;
}

Found Search::settle(const Found& from, double within) {
  if (from.reached == Reached::nothing) return from;
  constexpr int most_steps = 15;
  const Eigen::MatrixX3d nil = Eigen::MatrixX3d::Zero(from.state.u.rows(), 3);
  for (const Reached aim : {Reached::all, Reached::constraints}) {
    if (aim == Reached::all && from.reached != Reached::all) continue;
    here_ = from.state;
    for (int i = 0; i < most_steps; ++i) {
      (void)look(aim == Reached::all);
      if (here_.does && here_.largest <= within) return {aim, here_};
      here_.u = move_.descend(here_.u, nil, rows_, within, most_of_step() / 2);
    }
  }
  return {Reached::nothing, here_};
}

std::unique_ptr<const Handles> free_handles(const Body& body, const DeformOptions& options,
                                            const Control& control) {
  const DeformSettings& settings = options.settings;
  if (settings.handles == HandleKind::lattice)
    return std::make_unique<Lattice>(body.local.vertices, options.spans);
  return std::make_unique<CageHandles>(weighted_cage(body.local, settings.level, settings.grid, control));
}

std::unique_ptr<const Handles> handles_of(const Body& body, const DeformOptions& options,
                                          const Control& control) {
  std::unique_ptr<const Handles> handles = free_handles(body, options, control);
  if (!options.held) return handles;
  return std::make_unique<HeldHandles>(std::move(handles), options.held);
}

Deformation described(const Body& body, const Problem& problem, const LeastMove& move, const Found& found) {
  Deformation result;
  result.reached = found.reached;
  result.anchor = problem.anchor();
  result.local = move.motion().moved(found.state.u);
  if (move.held()) {
    // What is held is where it was: the anchor has moved, not all else.
    const Vec3 moved = move.motion().of_anchor(found.state.u).transpose();
    for (Vec3& v : result.local.vertices) v += moved;
    result.anchor += moved;
  }
  Eigen::Index most = 0;
  result.largest = move.displacement(found.state.u).rowwise().norm().maxCoeff(&most);
  result.where = body.local.vertices[static_cast<std::size_t>(most)];
  const auto volume = [](const TriangleMesh& mesh) { return reference::mesh_moments(mesh).value[S1]; };
  result.volume = volume(result.local) / volume(body.local);
  result.least_determinant = move.least_determinant(found.state.u);
  result.missed = found.state.missed;
  return result;
}

/// One search, with one limit to how much space may shrink.
Deformation search(const Body& body, const Problem& problem, const ShapeRays& rays,
                   const DeformOptions& options, device::Device& device, const Control& control) {
  const std::unique_ptr<const Handles> handles = handles_of(body, options, control);
  Separation separation(body, problem, options.margin, control.stop);
  std::vector<DeformStep> history;
  const auto of = [&](const Body& one) {
    return Search(one, problem, rays, options, *handles, separation, history, device, control);
  };
  Search fine = of(body);
  const std::optional<Body> plain = plainer(body);
  std::optional<Search> coarse;
  if (plain) coarse.emplace(of(*plain));
  Search& searched = coarse ? *coarse : fine;
  Found found = searched.find();
  const bool too_far = options.within && found.state.largest > *options.within;
  if (options.within && !too_far && found.reached != Reached::nothing)
    found = searched.improve(found, *options.within);
  if (coarse) found = fine.settle(found, too_far ? infinity : options.within.value_or(infinity));
  Deformation result = described(body, problem, fine.move(), found);
  result.too_far = too_far && found.reached != Reached::nothing;
  if (result.too_far) result.reached = Reached::nothing;
  result.history = std::move(history);
  return result;
}

}  // namespace

std::string_view to_string(Reached reached) {
  return reached == Reached::all ? "all" : reached == Reached::constraints ? "constraints" : "nothing";
}

Deformation deform(const Body& body, const Problem& problem, const ShapeRays& rays,
                   const DeformOptions& options, device::Device& device, const Control& control) {
  const Stopwatch watch;
  const StopScope scope(control.stop);
  DeformOptions stiffer = options;
  Deformation result;
  // A motion that shrinks space nowhere by much may fold a surface onto itself all the same.
  for (const double floor : {options.move.least_determinant, 0.65, 0.8}) {
    stiffer.move.least_determinant = std::max(floor, options.move.least_determinant);
    result = search(body, problem, rays, stiffer, device, control);
    if (result.reached == Reached::nothing) break;
    control.tell("deform: look for crossings");
    result.crossings = self_intersections(result.local).size();
    if (result.crossings == 0) break;
  }
  if (result.crossings > 0) result.reached = Reached::nothing;
  result.seconds = watch.seconds();
  return result;
}

}  // namespace kreisel::core
