// known_objectives.hpp - functions whose maximum is known.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "nest/search/objective.hpp"

namespace kreisel::core::nest {

/// -|x - target|^2 over numbers, directions and rotations: angles squared for the last two. 0 at the target.
/// Infeasible where the first number is under `wall`.
class Target : public Objective {
 public:
  Target(std::vector<Block> blocks, std::vector<double> target, double wall = -1e9)
      : space_(std::move(blocks)), target_(std::move(target)), wall_(wall) {}

  const Space& space() const override { return space_; }
  std::vector<double> values(std::span<const double> positions, std::span<const double> floors) override {
    const auto size = static_cast<std::size_t>(space_.size());
    std::vector<double> values;
    for (std::size_t i = 0; i * size < positions.size(); ++i) {
      const double v = value(positions.subspan(i * size, size));
      // What is not above its floor need not be exact.
      values.push_back(v > floors[i] ? v : std::min(floors[i], v + 1e-3));
    }
    asked_ += values.size();
    return values;
  }
  double value(std::span<const double> x) const {
    if (x[0] < wall_) return -std::numeric_limits<double>::infinity();
    double sum = 0;
    std::size_t at = 0;
    for (const Block& block : space_.blocks()) {
      if (block.kind == Block::number) {
        sum += (x[at] - target_[at]) * (x[at] - target_[at]);
      } else {
        double dot = 0;
        for (int k = 0; k < block.size(); ++k) dot += x[at + k] * target_[at + k];
        if (block.kind == Block::rotation) dot = std::abs(dot);
        const double angle = std::acos(std::min(1.0, dot)) * (block.kind == Block::rotation ? 2 : 1);
        sum += angle * angle;
      }
      at += static_cast<std::size_t>(block.size());
    }
    return -sum;
  }
  std::size_t asked() const { return asked_; }

 private:
  Space space_;
  std::vector<double> target_;
  double wall_;
  std::size_t asked_ = 0;
};

}  // namespace kreisel::core::nest
