// space.hpp - positions made of numbers, directions and rotations, as vectors that can be projected.
#pragma once

#include <span>
#include <vector>

namespace kreisel::core::nest {

/// One part of a position: a number in [lower, upper], a unit vector, or a rotation as a unit quaternion
/// (w, x, y, z), q and -q being one.
struct Block {
  enum Kind { number, direction, rotation } kind = number;
  double lower = 0, upper = 1;  ///< of a number

  [[nodiscard]] int size() const { return kind == number ? 1 : kind == direction ? 3 : 4; }
  /// Degrees of freedom, and so the uniform numbers that make a random one.
  [[nodiscard]] int freedom() const { return kind == number ? 1 : kind == direction ? 2 : 3; }
  [[nodiscard]] int steps() const { return kind == number ? 1 : 3; }
};

/// Positions as vectors: blocks one after the other.
class Space {
 public:
  Space() = default;
  explicit Space(std::vector<Block> blocks);

  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }
  [[nodiscard]] int size() const { return size_; }        ///< numbers in a position
  [[nodiscard]] int freedom() const { return freedom_; }  ///< dimensions of the manifold
  [[nodiscard]] int steps() const { return steps_; }      ///< numbers that move() takes

  /// The nearest position of the space. Vectors of length zero become the first axis.
  void project(std::span<double> x) const;

  /// out = target - x, for a rotation with the sign of `target` that is nearer to x.
  void towards(std::span<const double> x, std::span<const double> target, std::span<double> out) const;

  /// The position that freedom() numbers in [0, 1) stand for; uniform numbers give uniform numbers,
  /// directions and rotations (rotation.hpp).
  void place(std::span<const double> unit, std::span<double> x) const;

  /// x moved by steps() numbers: of a number, in units of its range; of others the axis times the angle in
  /// radians of a turn, so that a step means the same wherever x is. Then projected.
  void move(std::span<const double> step, std::span<double> x) const;

 private:
  std::vector<Block> blocks_;
  int size_ = 0, freedom_ = 0, steps_ = 0;
};

}  // namespace kreisel::core::nest
