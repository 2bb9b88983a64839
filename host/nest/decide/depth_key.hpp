// depth_key.hpp - depths as whole numbers that sort like them (nest_raster.h).
#pragma once

#include <bit>
#include <cstdint>

namespace kreisel::core::nest {

/// The depth that a key stands for.
inline float depth_of(std::uint32_t key) {
  return std::bit_cast<float>(key & 0x80000000u ? key & 0x7fffffffu : ~key);
}

}  // namespace kreisel::core::nest
