// probe.hpp - measured ceilings of a device: what a kernel's speed is held against.
#pragma once

#include "device/device.hpp"

namespace kreisel::device {

/// Medians of several launches after a warm-up. A rate of 0 was not measured (no fp64).
struct Ceilings {
  double copy_bytes_per_s = 0;  ///< read + written bytes of a copy kernel
  double flops_double = 0;      ///< fused multiply-adds in registers, 2 flops each
  double flops_single = 0;
  std::size_t array_bytes = 0;  ///< of each of the two arrays
  std::size_t cache_bytes = 0;  ///< last-level cache that the arrays were sized by
};

/// Rates of plain C++ loops on the host's own threads, over the same arrays: the cross-check of a CPU device.
struct HostCeilings {
  double copy_bytes_per_s = 0;
  double flops_double = 0;
};

/// Last-level cache of the host, from the system; 32 MiB when it does not say.
[[nodiscard]] std::size_t host_cache_bytes();

/// Measures on arrays of at least ten times the last-level cache (bounded by a quarter of the device's
/// memory).
[[nodiscard]] Ceilings measure(Device& device);
[[nodiscard]] HostCeilings measure_host(std::size_t array_bytes);

}  // namespace kreisel::device
