#include "deform/deform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "body/mesh_moments.hpp"
#include "deform/handles.hpp"
#include "deform/motion.hpp"
#include "deform/nearest_point.hpp"
#include "deform/submerged.hpp"
#include "geometry/triangle.hpp"
#include "solve/dual.hpp"
#include "solve/relaxed.hpp"
#include "stop.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double met = 1e-6;           ///< what misses by less misses by round-off
constexpr double most_of_step = 0.04;  ///< of the longest side: as far as derivatives are trusted

/// Vertices spread evenly over a surface, one a cell of a twentieth of its longest side.
std::vector<Eigen::Index> spread_vertices(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh);
  const double cell = box.extent().maxCoeff() / 20;
  std::map<std::array<int, 3>, Eigen::Index> first;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 at = (mesh.vertices[i] - box.lo) / cell;
    first.try_emplace({static_cast<int>(at[0]), static_cast<int>(at[1]), static_cast<int>(at[2])},
                      static_cast<Eigen::Index>(i));
  }
  std::vector<Eigen::Index> chosen;
  for (const auto& [place, vertex] : first) chosen.push_back(vertex);
  return chosen;
}

/// These vertices, and the air a little above them.
std::vector<Vec3> watched_points(const TriangleMesh& mesh, const std::vector<Eigen::Index>& vertices) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) normals[v] += normal_of(mesh, t);
  const double above = 0.04 * bounding_box(mesh).extent().maxCoeff();
  std::vector<Vec3> points;
  for (const Eigen::Index v : vertices) {
    const auto i = static_cast<std::size_t>(v);
    points.push_back(mesh.vertices[i]);
    points.push_back(mesh.vertices[i] + above * normals[i].normalized());
  }
  return points;
}

LinearConstraints joined(const LinearConstraints& a, const LinearConstraints& b) {
  LinearConstraints all = a;
  const Eigen::Index n = a.matrix.rows(), m = b.matrix.rows();
  all.matrix.conservativeResize(n + m, Eigen::NoChange);
  all.lower.conservativeResize(n + m);
  all.upper.conservativeResize(n + m);
  if (m > 0) all.matrix.bottomRows(m) = b.matrix, all.lower.tail(m) = b.lower, all.upper.tail(m) = b.upper;
  all.names.insert(all.names.end(), b.names.begin(), b.names.end());
  return all;
}

/// Midway between the largest and the least along each axis.
Eigen::RowVector3d middle(const Eigen::MatrixX3d& d) {
  return (d.colwise().maxCoeff() + d.colwise().minCoeff()) / 2;
}

class Search {
 public:
  Search(const Body& body, const Problem& problem, const ShapeRays& rays, const DeformOptions& options,
         device::Device& device, const Control& control)
      : body_(body),
        problem_(problem),
        rays_(rays),
        options_(options),
        device_(device),
        control_(control),
        side_(bounding_box(body.local).extent().maxCoeff()),
        handles_(handles_of(body, options)),
        motion_(body.local, *handles_, problem.anchor()),
        spread_(spread_vertices(body.local)),
        determinants_(watched_points(body.local, spread_), *handles_),
        rests_(bounding_box(body.local).lo[2] >= problem.anchor()[2] - 1e-6),
        constraints_(problem.constraints()),
        water_(problem.water()) {
    if (water_) submerged_before_ = submerged(body.local, water_->surface);
    const auto n = static_cast<Eigen::Index>(handles_->count());
    spread_rows_.resize(static_cast<Eigen::Index>(spread_.size()), n);
    for (std::size_t i = 0; i < spread_.size(); ++i)
      spread_rows_.row(static_cast<Eigen::Index>(i)) = motion_.row(spread_[i]);
    if (options.held) spread_rows_.rowwise() += motion_.anchor_row();
    bending_ = handles_->bending();
    here_.u = Eigen::MatrixX3d::Zero(n, 3);
    also_near_ = body.solid;
    emphasis_ = Eigen::VectorXd::Ones(spread_rows_.rows());
  }

  Deformation run();

 private:
  /// A state of the handles, and what it is worth.
  struct State {
    Eigen::MatrixX3d u;
    double missed = infinity, largest = infinity;
    double falls_short = infinity;      ///< of all that it is to meet: what is left of the worst
    Moments moments = Moments::Zero();  ///< of the interior that misses least
    bool does = false;
  };
  /// A separating quadric, by the multipliers of the rows that are asked.
  using Cut = Eigen::VectorXd;

  static std::unique_ptr<const Handles> handles_of(const Body& body, const DeformOptions& options) {
    std::unique_ptr<const Handles> lattice = std::make_unique<Lattice>(body.local.vertices, options.spans);
    if (!options.held) return lattice;
    return std::make_unique<HeldHandles>(std::move(lattice), options.held);
  }

  /// Steps towards what meets `also`, too, or not; then polishes what does. Leaves the best in best_.
  bool reach(bool also, int most_steps);
  void look(bool also);
  void step(double most);
  void set_emphasis(const Eigen::MatrixX3d& u, double power);
  [[nodiscard]] Eigen::MatrixXd energy() const;
  void add_dips(HandleRows& rows, const Eigen::MatrixX3d& u) const;
  void add_determinants(HandleRows& rows, const Eigen::MatrixX3d& u) const;
  [[nodiscard]] double largest(const Eigen::MatrixX3d& u) const {
    Eigen::MatrixX3d d = motion_.displacement(u);
    if (options_.held)
      d.rowwise() += motion_.of_anchor(u);
    else
      d.rowwise() -= middle(d);
    return d.rowwise().norm().maxCoeff();
  }
  Deformation described(const State& state, Reached reached);

  const Body& body_;
  const Problem& problem_;
  const ShapeRays& rays_;
  const DeformOptions& options_;
  device::Device& device_;
  const Control& control_;
  double side_;
  std::unique_ptr<const Handles> handles_;
  Motion motion_;
  std::vector<Eigen::Index> spread_;
  Determinants determinants_;
  bool rests_;  ///< on its anchor
  const LinearConstraints& constraints_;
  std::optional<Water> water_;
  Moments submerged_before_ = Moments::Zero();
  Eigen::MatrixXd spread_rows_, bending_;
  Eigen::VectorXd emphasis_;  ///< of the vertices that are spread over the surface

  Moments also_near_;  ///< of interiors like this what is asked beyond the constraints is made rows
  State here_;
  std::optional<State> best_;
  std::vector<Cut> cuts_;
  HandleRows cut_rows_;  ///< of the shape here
  std::vector<DeformStep> history_;
};

/// What of the interiors of this shape misses least, and the rows that all quadrics so far make of it.
void Search::look(bool also) {
  control_.stop_if_asked();
  const Shape shape(body_, motion_.moved(here_.u), rays_, device_);
  LinearConstraints asked = constraints_;
  if (water_) {
    const Moments more = water_->density * (submerged(shape.mesh(), water_->surface) - submerged_before_);
    asked.lower += asked.matrix * more;
    asked.upper += asked.matrix * more;
  }
  if (also) asked = joined(asked, problem_.also_asked(also_near_));
  const Rows rows = rows_of(asked, true);
  const Relaxed relaxed(problem_, asked);
  const SolverEntry& moment = find_solver("moment", "quadric");
  SolverOptions enough;  // far below what is taken for met, at half of the passes of all digits
  enough.own = moment.read({{"tolerance", "1e-9"}});
  const Outcome outcome = solve(moment, shape.task(relaxed, control_.stop), enough);
  here_.moments = outcome.moments;
  here_.missed = rows.violation(outcome.moments);
  // Where all is met, any of many interiors may be the one: nothing to go by.
  if (here_.missed > met) also_near_ = outcome.moments;
  for (Cut& cut : cuts_) cut.conservativeResizeLike(Eigen::VectorXd::Zero(rows.size()));
  const double weight =
      outcome.multipliers.empty()
          ? 0
          : Eigen::Map<const Eigen::VectorXd>(outcome.multipliers.data(), rows.size()).sum();
  if (here_.missed > met && weight > 0)
    cuts_.push_back(Eigen::Map<const Eigen::VectorXd>(outcome.multipliers.data(), rows.size()) / weight);

  cut_rows_ = {};
  double worst = -infinity;
  for (const Cut& cut : cuts_) {
    const Moments q = rows.matrix.transpose() * cut;
    const double value = shape.least(q) - rows.bound.dot(cut);
    worst = std::max(worst, value);
    std::vector<Vec3> gradient = shape.gradient_of_least(q);
    if (water_) {
      const std::vector<Vec3> wet = submerged_gradient(shape.mesh(), water_->surface, q);
      for (std::size_t i = 0; i < wet.size(); ++i) gradient[i] -= water_->density * wet[i];
    }
    const Eigen::MatrixX3d slope = motion_.pulled_back(gradient);
    cut_rows_.add(slope, -options_.margin - value + slope.cwiseProduct(here_.u).sum());
  }
  here_.largest = largest(here_.u);
  const double shrunk = options_.least_determinant - determinants_.least(here_.u);
  here_.does = here_.missed <= met && worst <= -options_.margin / 2 && shrunk <= 0;
  here_.falls_short = std::max({here_.missed, worst + options_.margin / 2, 0.01 * shrunk});
  history_.push_back(
      {here_.missed, here_.largest, problem_.value(outcome.moments), static_cast<int>(cuts_.size())});
  control_.tell(fmt::format("deform: step {}, missed by {:.4f}, moved by {:.1f} %", history_.size(),
                            here_.missed, 100 * here_.largest / side_));
}

Eigen::MatrixXd Search::energy() const {
  const double total = emphasis_.sum();
  Eigen::MatrixXd square = spread_rows_.transpose() * emphasis_.asDiagonal() * spread_rows_ / total;
  if (!options_.held) {
    const Eigen::RowVectorXd mean = emphasis_.transpose() * spread_rows_ / total;
    square -= mean.transpose() * mean;
  }
  square += options_.bending * bending_;
  square.diagonal().array() += 1e-7;  // of what moves nothing
  return square;
}

/// What is displaced most counts most: the p-norm of the displacements as a sum of squares whose weights are
/// their powers of p - 2. From square to square they go a part of the way, for all of it overshoots.
void Search::set_emphasis(const Eigen::MatrixX3d& u, double power) {
  Eigen::MatrixX3d d = spread_rows_ * u;
  if (!options_.held) d.rowwise() -= Eigen::RowVector3d(emphasis_.transpose() * d / emphasis_.sum());
  const Eigen::VectorXd size = d.rowwise().norm();
  if (!(size.maxCoeff() > 0)) return;
  const Eigen::VectorXd wanted = (size / size.maxCoeff()).array().pow(power - 2).max(1e-6);
  const double part = 1.5 / (power - 1);
  emphasis_ = emphasis_.array().pow(1 - part) * wanted.array().pow(part);
  emphasis_ /= emphasis_.maxCoeff();
}

/// A body on its lowest point stays on it: rows for what is lowest at u.
void Search::add_dips(HandleRows& rows, const Eigen::MatrixX3d& u) const {
  if (!rests_) return;
  const Eigen::MatrixX3d d = motion_.displacement(u);
  std::map<std::array<int, 2>, std::pair<double, Eigen::Index>> lowest;  // one a cell of the ground
  const double floor = problem_.anchor()[2], near = 0.1 * side_, cell = side_ / 20;
  for (std::size_t i = 0; i < body_.local.vertices.size(); ++i) {
    const Vec3& v = body_.local.vertices[i];
    const auto vertex = static_cast<Eigen::Index>(i);
    const double height = v[2] + d(vertex, 2) - floor;
    if (height > near) continue;
    const std::array place = {static_cast<int>(std::floor(v[0] / cell)),
                              static_cast<int>(std::floor(v[1] / cell))};
    const auto [at, is_new] = lowest.try_emplace(place, height, vertex);
    if (!is_new && height < at->second.first) at->second = {height, vertex};
  }
  for (const auto& [place, low] : lowest) {
    const double before = body_.local.vertices[static_cast<std::size_t>(low.second)][2] - floor;
    Eigen::MatrixX3d row = Eigen::MatrixX3d::Zero(motion_.handles(), 3);
    row.col(2) = -motion_.row(low.second).transpose();
    rows.add(row, before - std::min(before, 2e-3) / 2);
  }
}

/// Rows, linear about here, for where space is shrunk most here or at u.
void Search::add_determinants(HandleRows& rows, const Eigen::MatrixX3d& u) const {
  std::vector<std::pair<double, std::size_t>> small;
  for (std::size_t i = 0; i < determinants_.size(); ++i)
    if (const double at = std::min(determinants_.at(i, here_.u), determinants_.at(i, u));
        at < options_.least_determinant + 0.2)
      small.emplace_back(at, i);
  constexpr std::size_t most = 150;
  std::ranges::sort(small);
  if (small.size() > most) small.resize(most);
  for (const auto& [at, i] : small) {
    const Eigen::MatrixX3d slope = determinants_.gradient(i, here_.u);
    rows.add(-slope, determinants_.at(i, here_.u) - options_.least_determinant - 0.02 -
                         slope.cwiseProduct(here_.u).sum());
  }
}

/// @param most  as far as any vertex goes
void Search::step(double most) {
  constexpr double penalty = 1e3;
  static const int rounds = getenv("ROUNDS") ? atoi(getenv("ROUNDS")) : 4;
  static const double power = getenv("POWER") ? atof(getenv("POWER")) : 12;
  const Eigen::MatrixX3d nil = Eigen::MatrixX3d::Zero(motion_.handles(), 3);
  Eigen::MatrixX3d to = here_.u;
  for (int round = 0; round < rounds; ++round) {
    HandleRows rows = cut_rows_;
    add_dips(rows, to);
    add_determinants(rows, to);
    to = nearest_point(energy(), nil, nil, rows, penalty);
    const double far = motion_.displacement(to - here_.u).rowwise().norm().maxCoeff();
    to = here_.u + std::min(1.0, most / std::max(far, 1e-300)) * (to - here_.u);
    set_emphasis(to, power);
  }
  here_.u = to;
}

bool Search::reach(bool also, int most_steps) {
  best_.reset();
  double most = most_of_step * side_, least_short = infinity;
  int in_vain = 0;
  for (int i = 0; i < most_steps; ++i) {
    look(also);
    if (here_.does && (!best_ || here_.largest < best_->largest)) {
      if (best_ && here_.largest > 0.998 * best_->largest) most /= 2;
      best_ = here_;
    } else if (best_) {
      most /= 1.5;
    } else if (here_.falls_short > least_short) {
      most = std::max(most / 1.5, 0.25 * most_of_step * side_);  // it goes to and fro
    }
    in_vain = here_.falls_short > 0.95 * least_short ? in_vain + 1 : 0;
    if (!best_ && in_vain > 12) break;
    least_short = std::min(least_short, here_.falls_short);
    if (most < 1e-3 * side_) break;
    if (!best_ && here_.largest > 0.4 * side_) break;  // that is another body
    step(most);
  }
  return best_.has_value();
}

Deformation Search::described(const State& state, Reached reached) {
  Deformation result;
  result.reached = reached;
  result.local = motion_.moved(state.u);
  Eigen::MatrixX3d d = motion_.displacement(state.u);
  result.anchor = problem_.anchor();
  if (options_.held) {
    // What is held is where it was: the anchor has moved, not all else.
    const Eigen::RowVector3d moved = motion_.of_anchor(state.u);
    d.rowwise() += moved;
    for (Vec3& v : result.local.vertices) v += moved.transpose();
    result.anchor += moved.transpose();
  } else {
    d.rowwise() -= middle(d);
  }
  Eigen::Index most = 0;
  result.largest = d.rowwise().norm().maxCoeff(&most);
  result.where = body_.local.vertices[static_cast<std::size_t>(most)];
  result.volume =
      (reference::mesh_moments(result.local).value / reference::mesh_moments(body_.local).value[S1])[S1];
  result.least_determinant = determinants_.least(state.u);
  result.missed = reached == Reached::nothing ? state.missed : 0;
  result.history = history_;
  return result;
}

Deformation Search::run() {
  constexpr int most_steps = 60;
  const bool more = problem_.also_asked(body_.solid).matrix.rows() > 0;
  look(more);
  if (here_.does) return described(here_, Reached::all);
  if (more) cuts_.clear();  // of the rows beyond the constraints
  if (!reach(false, most_steps)) return described(here_, Reached::nothing);
  if (!more) return described(*best_, Reached::all);
  const State balanced = *best_;
  here_ = balanced;
  if (reach(true, most_steps)) return described(*best_, Reached::all);
  return described(balanced, Reached::constraints);
}

}  // namespace

std::string_view to_string(Reached reached) {
  return reached == Reached::all ? "all" : reached == Reached::constraints ? "constraints" : "nothing";
}

Deformation deform(const Body& body, const Problem& problem, const ShapeRays& rays,
                   const DeformOptions& options, device::Device& device, const Control& control) {
  const Stopwatch watch;
  const StopScope scope(control.stop);
  Deformation result = Search(body, problem, rays, options, device, control).run();
  result.seconds = watch.seconds();
  return result;
}

}  // namespace kreisel::core
