// random.hpp - random numbers that are a function of where they are used.
#pragma once

#include <cstdint>

namespace kreisel::core::nest {

/// A uniform number in [0, 1) for each (seed, a, b, c). There is no state: numbers don't depend on the order
/// in which, or the thread on which, they are asked for, and a search goes on from a checkpoint as if it had
/// never stopped. [splitmix64: Steele, Lea, Flood 2014, Fast splittable pseudorandom number generators]
[[nodiscard]] inline double uniform(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0,
                                    std::uint64_t c = 0) {
  std::uint64_t z = seed;
  for (const std::uint64_t part : {a, b, c}) {
    z += 0x9e3779b97f4a7c15u + part;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
  }
  return static_cast<double>(z >> 11) * 0x1p-53;
}

}  // namespace kreisel::core::nest
