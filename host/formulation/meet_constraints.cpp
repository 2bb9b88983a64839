#include "formulation/meet_constraints.hpp"

#include <algorithm>
#include <cmath>

#include "formulation/dense_void.hpp"

namespace kreisel {
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
      const Interval& run = intervals[i];
      for (int k = run.k0; k < run.k1; ++k) {
        const std::size_t v = set_.first(i) + static_cast<std::size_t>(k - run.k0);
        const bool solid = set_.solid(v);
        const bool end =
            (k > run.k0 && set_.solid(v - 1) != solid) || (k + 1 < run.k1 && set_.solid(v + 1) != solid);
        if (!end || moved_[v]) continue;
        Move move{v, run.ix + 1, run.iy + 1, k + 1, !solid};
        move.gain = before - squared_misses(constraints_, value_ + effect(move));
        if (move.gain > 0) moves.push_back(move);
      }
    }
    std::ranges::stable_sort(moves, std::ranges::greater{}, &Move::gain);
    return moves;
  }

  /// Makes the move if it still helps and the surface stays a manifold.
  bool apply(const Move& move) {
    const Eigen::VectorXd value = value_ + effect(move);
    if (squared_misses(constraints_, value) >= squared_misses(constraints_, value_)) return false;
    const std::size_t cell = cells_.at(move.x, move.y, move.z);
    cells_.set_void(cell, !move.fills);
    for (int corner = 0; corner < 8; ++corner)
      if (offending_corner(
              cells_.block(move.x - (corner & 1), move.y - (corner >> 1 & 1), move.z - (corner >> 2))) >= 0) {
        cells_.set_void(cell, move.fills);
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

}  // namespace kreisel
