// micro.hpp - what the micro-benchmarks share: devices, ceilings of the moment, counters.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>

#include "body/moments.hpp"
#include "device/device.hpp"
#include "device/probe.hpp"

namespace kreisel::core::micro {

/// A device in one precision, with its probes.
struct Machine {
  explicit Machine(const std::string& selector, device::Precision precision)
      : device(selector, precision), probe(device, device::probe_array_bytes(device)) {}
  device::Device device;
  device::Probe probe;

  [[nodiscard]] std::string precision() const { return device.single() ? "single" : "double"; }
};

/// What an element costs at least: every byte moved once, every operation done once.
struct Floor {
  double bytes, flops;
  bool writes;  ///< as much as it reads, about: the ceiling is that of a copy, else that of reading
};

/// Operations an element costs beyond its terms: in single precision, ten compensated additions of seven each
/// a run. In double precision a run could as well go on to the end.
[[nodiscard]] double accumulation(const device::Device& device);

/// Where a check failed; main() ends with 1 then.
inline bool all_agree = true;

/// Whether sums lie within a kernel's bound of a reference that adds up n terms one after the other.
[[nodiscard]] bool agree(const Moments& got, const MomentSums& want, double bound, std::size_t n);

/// Times `launch` by the device's own clock, and reports bytes/s, flop/s and the share of the binding
/// ceiling: the floor's time at the ceilings measured just before, over the time taken. `check` says whether
/// the kernel agrees with its reference; it is asked once for each name, before anything is timed.
void time_kernel(benchmark::State& state, Machine& machine, const std::string& name, double elements,
                 const Floor& floor, const std::function<void()>& launch, const std::function<bool()>& check);

/// Times `loop`, the plain loop on one thread beside a kernel.
void time_loop(benchmark::State& state, double elements, double bytes, const std::function<void()>& loop);

/// Sizes from bound by the launch to ten times the last-level cache.
[[nodiscard]] std::vector<std::size_t> sizes(const device::Device& device, double bytes_an_element);

void register_rays(Machine& machine, bool reference);
void register_quadric(Machine& machine, bool reference);
void register_voxels(Machine& machine, bool reference);
void register_meshes(Machine& machine, bool reference);

/// Sums of an octree's leaves beside the plain loop over the same leaves.
void register_cells(Machine& machine, const std::string& model);

/// Crossings beside Embree's rays, distances, and the whole way from mesh to domain.
/// @param model  a name or a mesh file
void register_domain(Machine& machine, const std::string& model);

}  // namespace kreisel::core::micro
