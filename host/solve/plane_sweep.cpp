#include "solve/plane_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "error.hpp"
#include "problem/stand.hpp"
#include "stopwatch.hpp"

namespace kreisel::core {
namespace {

using Vec2 = Eigen::Vector2d;
using Piece = Eigen::Vector4d;  ///< s1 sx sy sz, the first four of the moments

/// What of the totals each variable holds.
std::vector<Piece> pieces_of(const Task& task, std::span<const double> x) {
  const std::array<Moments, 4> weights = {Moments::Unit(S1), Moments::Unit(SX), Moments::Unit(SY),
                                          Moments::Unit(SZ)};
  std::vector<double> rows(weights.size() * x.size());
  task.formulation.pull_back(x, weights, rows);
  std::vector<Piece> pieces(x.size());
  for (std::size_t i = 0, n = x.size(); i < n; ++i)
    pieces[i] = task.mass.contrast * Piece(rows[i], rows[n + i], rows[2 * n + i], rows[3 * n + i]);
  return pieces;
}

/// The totals while pieces are carved.
class Sweep {
 public:
  Sweep(std::vector<Piece> pieces, const Moments& solid, const Stand& stand)
      : pieces_(std::move(pieces)), carved_(pieces_.size(), false), total_(solid.head<4>()), stand_(stand) {}

  [[nodiscard]] double error() const { return off(total_).norm(); }
  [[nodiscard]] bool carved(std::size_t i) const { return carved_[i]; }
  [[nodiscard]] Moments moments() const {
    Moments s = Moments::Zero();
    s.head<4>() = total_;
    return s;
  }

  /// One sweep of the plane. @return  whether anything was carved: not when none brings the centre nearer
  bool round() {
    const std::vector<std::size_t> order = in_order();
    Piece left = total_;
    double least = error();
    std::size_t best = 0;
    Piece best_left = total_;
    for (std::size_t n = 0; n < order.size(); ++n) {
      left -= pieces_[order[n]];
      // Round-off of the sums is no progress, and would keep the rounds going.
      constexpr double round_off = 1e-12;
      if (const double e = off(left).norm(); e < least - round_off) {
        least = e;
        best = n + 1;
        best_left = left;
      }
    }
    for (std::size_t n = 0; n < best; ++n) carved_[order[n]] = true;
    total_ = best_left;
    return best > 0;
  }

 private:
  [[nodiscard]] static Vec2 centre(const Piece& s) { return s.segment<2>(SX) / s[S1]; }
  /// From the nearest of the points that will do to the centre; zero where it is over one.
  [[nodiscard]] Vec2 off(const Piece& s) const { return centre(s) - stand_.nearest_target(centre(s)); }

  /// What is left beyond the plane through the target, the farthest first; nothing once that is reached.
  [[nodiscard]] std::vector<std::size_t> in_order() const {
    const Vec2 target = stand_.nearest_target(centre(total_)), normal = off(total_).normalized();
    std::vector<double> distance(pieces_.size());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (carved_[i]) continue;
      distance[i] = normal.dot(centre(pieces_[i]) - target);
      if (distance[i] > 0) order.push_back(i);
    }
    const auto height = [&](std::size_t i) { return pieces_[i][SZ] / pieces_[i][S1]; };
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
      if (distance[a] != distance[b]) return distance[a] > distance[b];
      if (height(a) != height(b)) return height(a) > height(b);
      return a < b;
    });
    return order;
  }

  std::vector<Piece> pieces_;
  std::vector<bool> carved_;
  Piece total_;
  const Stand& stand_;
};

}  // namespace

Outcome solve_with_plane_sweep(const Task& task, const SolverOptions&) {
  const auto* stand = dynamic_cast<const Stand*>(&task.problem);
  if (!stand)
    throw InputError(fmt::format(
        "solver 'plane-sweep' for {} as it is set; expected the problem stand with target = centre "
        "or inside",
        task.problem.name()));
  Outcome outcome;
  task.device.reset_kernel_seconds();
  const Stopwatch watch;
  std::vector<double> x = task.formulation.start(Start::upper);
  const Moments solid = task.total(x);
  Sweep sweep(pieces_of(task, x), solid, *stand);
  do {
    const Moments s = sweep.moments();
    outcome.history.push_back({static_cast<int>(outcome.history.size()), task.problem.value(s),
                               violation(task.problem, s), 0, 0, 0, 0});
  } while (!task.stop.stop_requested() && sweep.round());
  for (std::size_t i = 0; i < x.size(); ++i)
    if (sweep.carved(i)) x[i] = 0;
  outcome.x = std::move(x);
  outcome.moments = task.total(outcome.x);
  outcome.objective = task.problem.value(outcome.moments);
  outcome.violation = violation(task.problem, outcome.moments);
  outcome.iterations = static_cast<int>(outcome.history.size()) - 1;
  outcome.evaluations.objective = 2;
  outcome.evaluations.gradient = 1;
  outcome.solve_seconds = watch.seconds();
  outcome.kernel_seconds = task.device.kernel_seconds();
  if (task.stop.stop_requested()) {
    outcome.termination = Termination::interrupted;
    outcome.message = "stopped by the user";
    return outcome;
  }
  // As near as verdicts ask of a centre of mass that is to be over a point.
  constexpr double near = 1e-3;
  outcome.termination = sweep.error() <= near ? Termination::acceptable : Termination::failed;
  outcome.message =
      fmt::format("{:.1e} L from over the target, and no carving brings it nearer", sweep.error());
  return outcome;
}

}  // namespace kreisel::core
