// exact_point_hash.hpp - three numbers as the key of a hash table.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace kreisel::core {

/// By the bits of the numbers: equal keys hash alike as long as -0 is made 0 (-0 + 0 is 0) and none is NaN.
struct ExactPointHash {
  std::size_t operator()(const std::array<double, 3>& key) const {
    std::uint64_t h = 0;
    for (const double x : key) {  // multiply and fold: neighbouring numbers differ in high bits only
      h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 32;
    }
    return h;
  }
};

}  // namespace kreisel::core
