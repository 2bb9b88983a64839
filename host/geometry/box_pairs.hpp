// box_pairs.hpp - which of many boxes overlap.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace kreisel::core {

/// A box in single precision. Small, for a mesh has one a triangle.
struct NumberedBox {
  Eigen::Vector3f lo, hi;
  std::uint32_t number;

  [[nodiscard]] bool meets(const NumberedBox& other) const {
    return (lo.array() <= other.hi.array()).all() && (other.lo.array() <= hi.array()).all();
  }
};

/// Calls visit(low, high) once for every two boxes that have a point in common, by their numbers: by all
/// threads, in any order. The boxes are halved until few are left, each half with those of others that reach
/// into it, so that besides the boxes hardly anything is kept. O(n log n + pairs) for those of a surface.
/// @param boxes    each with a number of its own
/// @param visit    may be called by several threads at once
void for_each_overlap(std::vector<NumberedBox> boxes,
                      const std::function<void(std::uint32_t low, std::uint32_t high)>& visit);

}  // namespace kreisel::core
