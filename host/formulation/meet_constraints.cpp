#include "formulation/meet_constraints.hpp"

#include <algorithm>
#include <cmath>

#include "formulation/dense_void.hpp"

namespace kreisel::core {
namespace {

/// A voxel that could change sides, and what that would do.
struct Move {
  std::size_t voxel;
  int x, y, z;  ///< cell of DenseVoid
  bool fills;
  double gain = 0;  ///< by how much the squared misses shrink
};

/// Squared distance of the constraints' values from their bounds.
double squared_misses(const LinearConstraints& c, const Eigen::VectorXd& value) {
  return (c.lower - value).cwiseMax(value - c.upper).cwiseMax(0).squaredNorm();
}

std::size_t length(const Interval& run) { return static_cast<std::size_t>(run.k1 - run.k0); }

class Fit {
 public:
  Fit(VoxelSet& set, const Problem& problem, const MassModel& mass)
      : set_(set),
        cells_(set),
        constraints_(problem.constraints()),
        forms_(mass.contrast * constraints_.matrix),
        value_(constraints_.matrix * mass.total(moments(set))),
        moved_(set.size(), false) {}

  std::size_t run() {
    std::size_t count = 0;
    // Each round moves as many voxels as shrink the misses by about a half, so rounds are few; the last ones
    // move one at a time.
    constexpr int most_rounds = 200;
    for (int round = 0; round < most_rounds; ++round) {
      std::vector<Move> moves = candidates();
      const double before = squared_misses(constraints_, value_);
      std::size_t in_round = 0;
      for (const Move& move : moves) {
        if (in_round > 0 && squared_misses(constraints_, value_) < before / 4) break;
        if (apply(move)) ++in_round;
      }
      if (in_round == 0) break;
      count += in_round;
    }
    return count;
  }

 private:
  [[nodiscard]] Eigen::VectorXd effect(const Move& move) const {
    const Grid& grid = set_.domain().grid;
    const Vec3 centre(grid.centre(0, move.x - 1), grid.centre(1, move.y - 1), grid.centre(2, move.z - 1));
    return (move.fills ? 1 : -1) * (forms_ * box_moments(centre, Vec3::Constant(grid.h)));
  }

  /// Moves that help, the best first.
  [[nodiscard]] std::vector<Move> candidates() const {
    std::vector<Move> moves;
    const double before = squared_misses(constraints_, value_);
    const auto& intervals = set_.domain().intervals;
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      const std::size_t first = set_.first(i), end = first + length(intervals[i]);
      const auto consider = [&](std::size_t v) {
        const Interval& run = intervals[i];
        if (moved_[v]) return;
        Move move{v, run.ix + 1, run.iy + 1, run.k0 + static_cast<int>(v - first) + 1, !set_.solid(v)};
        move.gain = before - squared_misses(constraints_, value_ + effect(move));
        if (move.gain > 0) moves.push_back(move);
      };
      // A voxel where the fill changes above and below is met twice.
      std::size_t last = end;
      for (std::size_t v = set_.next_change(first, end); v < end; v = set_.next_change(v, end)) {
        if (last != v - 1) consider(v - 1);
        consider(last = v);
      }
    }
    std::ranges::stable_sort(moves, std::ranges::greater{}, &Move::gain);
    return moves;
  }

  /// Makes the move if it still helps and the surface stays a manifold.
  bool apply(const Move& move) {
    const Eigen::VectorXd value = value_ + effect(move);
    if (squared_misses(constraints_, value) >= squared_misses(constraints_, value_)) return false;
    cells_.set_void(move.x, move.y, move.z, !move.fills);
    for (int corner = 0; corner < 8; ++corner)
      if (offending_corner(
              cells_.block(move.x - (corner & 1), move.y - (corner >> 1 & 1), move.z - (corner >> 2))) >= 0) {
        cells_.set_void(move.x, move.y, move.z, move.fills);
        return false;
      }
    set_.set(move.voxel, move.fills);
    moved_[move.voxel] = true;
    value_ = value;
    return true;
  }

  VoxelSet& set_;
  DenseVoid cells_;
  const LinearConstraints& constraints_;
  Eigen::Matrix<double, Eigen::Dynamic, 10> forms_;  ///< constraints of the domain's moments
  Eigen::VectorXd value_;                            ///< of the constraints, as the set is
  std::vector<bool> moved_;
};

}  // namespace

std::size_t meet_constraints(VoxelSet& set, const Problem& problem, const MassModel& mass) {
  return Fit(set, problem, mass).run();
}

}  // namespace kreisel::core
