#include <fmt/format.h>

#include "apps/bench/commands.hpp"
#include "device/probe.hpp"
#include "error.hpp"

namespace kreisel::core::bench {
namespace {

constexpr double giga = 1e9, mebi = 1 << 20, gibi = 1 << 30;

void print_measured(device::Device& device) {
  const device::Ceilings c = device::measure(device);
  const double fp64 = c.flops_double;
  fmt::print(
      "    measured   read {:.1f} GB/s, copy {:.1f} GB/s (arrays of {:.0f} MiB, {:.0f} times the last-level "
      "cache), {} fp64, "
      "{:.1f} Gflop/s fp32\n",
      c.read_bytes_per_s / giga, c.copy_bytes_per_s / giga, static_cast<double>(c.array_bytes) / mebi,
      static_cast<double>(c.array_bytes) / static_cast<double>(c.cache_bytes),
      fp64 > 0 ? fmt::format("{:.1f} Gflop/s", fp64 / giga) : "no", c.flops_single / giga);
  if (device.info().gpu) return;
  const device::HostCeilings host = device::measure_host(c.array_bytes);
  fmt::print(
      "    host       copy {:.1f} GB/s, {:.1f} Gflop/s fp64 by plain loops on all threads; device/host "
      "{:.2f} "
      "and {:.2f}\n",
      host.copy_bytes_per_s / giga, host.flops_double / giga, c.copy_bytes_per_s / host.copy_bytes_per_s,
      fp64 / host.flops_double);
}

}  // namespace

int devices(bool measure, const std::string& only) {
  const std::vector<device::Info> all = device::list();
  if (all.empty())
    throw InputError("no OpenCL device found; expected at least PoCL (Debian: apt install pocl-opencl-icd)");
  device::Device chosen(only);
  for (const device::Info& info : all) {
    if (!only.empty() && info.index != chosen.info().index) continue;
    fmt::print("{} {}{}\n", info.index, info.name, info.index == chosen.info().index ? "  (chosen)" : "");
    fmt::print("    platform   {}, {}, driver {}\n", info.platform, info.version, info.driver);
    fmt::print("    has        {} compute units at {} MHz, {:.1f} GiB memory, {:.1f} MiB cache, fp64 {}\n",
               info.compute_units, info.clock_mhz, static_cast<double>(info.memory_bytes) / gibi,
               static_cast<double>(info.cache_bytes) / mebi, info.fp64 ? "yes" : "no");
    if (!measure) continue;
    device::Device device(std::to_string(info.index));
    print_measured(device);
  }
  return done;
}

}  // namespace kreisel::core::bench
