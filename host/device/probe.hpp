// probe.hpp - measured ceilings of a device: what a kernel's speed is held against.
#pragma once

#include "device/device.hpp"

namespace kreisel::core::device {

/// One launch of each probe, again and again: the ceilings of the very moment, when a machine's speed varies.
class Probe {
 public:
  /// @param array_bytes  of each of the two arrays that copy() goes through
  Probe(Device& device, std::size_t array_bytes);

  [[nodiscard]] double read_bytes_per_s();  ///< summing one array, as the kernels that sum go through theirs
  [[nodiscard]] double copy_bytes_per_s();  ///< read + written bytes
  [[nodiscard]] double flops();             ///< fused multiply-adds in registers, the device's precision

  [[nodiscard]] std::size_t array_bytes() const { return array_bytes_; }

 private:
  Device* device_;
  std::size_t array_bytes_, groups_;
  cl::Buffer in_, out_;
  cl::Kernel read_, copy_, flops_;
};

/// Ten times the last-level cache, and at most an eighth of the device's memory.
[[nodiscard]] std::size_t probe_array_bytes(const Device& device);

/// Medians of several launches after a warm-up. A rate of 0 was not measured (no fp64).
struct Ceilings {
  double read_bytes_per_s = 0;  ///< of a summing kernel
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

}  // namespace kreisel::core::device
