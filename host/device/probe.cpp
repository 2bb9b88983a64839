#include "device/probe.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include "device/buffer.hpp"
#include "device/program.hpp"
#include "statistics.hpp"
#include "stopwatch.hpp"

namespace kreisel::core::device {
namespace {

constexpr int launches = 7;
constexpr std::size_t work_group = 64;
constexpr int read_block = 1 << 15;  // elements a work-group sums: a few hundred kilobytes

double seconds_of(Device& device, const cl::Kernel& kernel, std::size_t items, std::size_t group) {
  device.reset_kernel_seconds();
  device.run(kernel, items, group);
  const double seconds = device.kernel_seconds();
  device.reset_kernel_seconds();
  return seconds;
}

/// Median of several values of `rate`, after one that is not counted.
template <class Rate>
double median_rate(Rate&& rate) {
  std::vector<double> rates;
  for (int i = 0; i <= launches; ++i) {
    const double value = rate();
    if (i > 0) rates.push_back(value);
  }
  return median(std::move(rates));
}

constexpr int rounds = 10000;  // of 64 multiply-adds, 2 flops each

std::size_t flop_items(const Device& device) {
  return static_cast<std::size_t>(device.info().compute_units) * 64 * (device.info().gpu ? 64 : 4);
}

cl::Kernel flop_kernel(Device& device, bool single, const cl::Buffer& out) {
  cl::Kernel kernel(build(device, "probe", single && !device.single() ? "-DKREISEL_SINGLE" : ""),
                    "probe_flops");
  kernel.setArg(0, rounds);
  if (single) {
    kernel.setArg(1, 0.999f);
    kernel.setArg(2, 0.001f);
  } else {
    kernel.setArg(1, 0.999);
    kernel.setArg(2, 0.001);
  }
  kernel.setArg(3, out);
  return kernel;
}

double flop_rate(Device& device, bool single) {
  const std::size_t items = flop_items(device);
  const cl::Buffer out(device.context(), CL_MEM_WRITE_ONLY, items * sizeof(double));
  const cl::Kernel kernel = flop_kernel(device, single, out);
  return median_rate([&] {
    return static_cast<double>(items) * rounds * 64 * 2 / seconds_of(device, kernel, items, work_group);
  });
}

/// Seconds of `work(thread)` on every hardware thread at once, median of several.
double on_all_threads(const std::function<void(unsigned)>& work) {
  std::vector<double> seconds;
  for (int i = 0; i <= launches; ++i) {
    const Stopwatch watch;
    {
      std::vector<std::jthread> threads;
      for (unsigned t = 0; t < std::thread::hardware_concurrency(); ++t) threads.emplace_back(work, t);
    }
    if (i > 0) seconds.push_back(watch.seconds());
  }
  return median(std::move(seconds));
}

constexpr int chains = 64;

/// `repeats` x `chains` multiply-adds in registers, with the widest vectors this processor has.
// The sanitizers are not there yet when the loader picks one of the clones.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
double
multiply_adds(double a, double b, unsigned seed, int repeats) {
  double x[chains];
  for (int c = 0; c < chains; ++c) x[c] = c + seed;
  for (int r = 0; r < repeats; ++r)
    for (int c = 0; c < chains; ++c) x[c] = x[c] * a + b;
  double sum = 0;
  for (int c = 0; c < chains; ++c) sum += x[c];
  return sum;
}

}  // namespace

std::size_t host_cache_bytes() {
  const long l3 = sysconf(_SC_LEVEL3_CACHE_SIZE), l2 = sysconf(_SC_LEVEL2_CACHE_SIZE);
  const long largest = std::max(l3, l2);
  return largest > 0 ? static_cast<std::size_t>(largest) : std::size_t{32} << 20;
}

std::size_t probe_array_bytes(const Device& device) {
  const std::size_t cache = device.info().cache_bytes ? device.info().cache_bytes : host_cache_bytes();
  const std::size_t wanted = 10 * std::max<std::size_t>(cache, std::size_t{4} << 20);
  return std::min<std::size_t>(wanted, device.info().memory_bytes / 8);
}

Probe::Probe(Device& device, std::size_t array_bytes) : device_(&device) {
  const std::size_t block_bytes = read_block * device.real_bytes();
  groups_ = std::max<std::size_t>(array_bytes / block_bytes, 1);
  array_bytes_ = groups_ * block_bytes;
  checked("making the probes", [&] {
    in_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, array_bytes_);
    out_ = cl::Buffer(device.context(), CL_MEM_READ_WRITE, array_bytes_);
    device.queue().enqueueFillBuffer(in_, 1.0f, 0, array_bytes_);
    device.queue().enqueueFillBuffer(out_, 1.0f, 0, array_bytes_);
    const cl::Program program = build(device, "probe");
    read_ = cl::Kernel(program, "probe_read");
    read_.setArg(0, read_block);
    read_.setArg(1, static_cast<int>(array_bytes_ / device.real_bytes()));
    read_.setArg(2, in_);
    read_.setArg(3, out_);
    copy_ = cl::Kernel(program, "probe_copy");
    copy_.setArg(0, in_);
    copy_.setArg(1, out_);
    flops_ = flop_kernel(device, device.single(), out_);
  });
}

double Probe::read_bytes_per_s() {
  const auto group = static_cast<std::size_t>(device_->group_items());
  return static_cast<double>(array_bytes_) / seconds_of(*device_, read_, groups_ * group, group);
}

double Probe::copy_bytes_per_s() {
  const std::size_t items = array_bytes_ / (4 * device_->real_bytes());
  return 2.0 * static_cast<double>(array_bytes_) / seconds_of(*device_, copy_, items, work_group);
}

double Probe::flops() {
  const std::size_t items = flop_items(*device_);
  return static_cast<double>(items) * rounds * 64 * 2 / seconds_of(*device_, flops_, items, work_group);
}

Ceilings measure(Device& device) {
  Ceilings result;
  result.cache_bytes = device.info().cache_bytes ? device.info().cache_bytes : host_cache_bytes();
  checked("measuring bandwidth", [&] {
    Probe probe(device, probe_array_bytes(device));
    result.array_bytes = probe.array_bytes();
    result.read_bytes_per_s = median_rate([&] { return probe.read_bytes_per_s(); });
    result.copy_bytes_per_s = median_rate([&] { return probe.copy_bytes_per_s(); });
  });
  checked("measuring arithmetic", [&] {
    result.flops_single = flop_rate(device, true);
    if (!device.single()) result.flops_double = flop_rate(device, false);
  });
  return result;
}

HostCeilings measure_host(std::size_t array_bytes) {
  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t n = array_bytes / sizeof(double) / threads;
  std::vector<double> in(n * threads, 1.0), out(n * threads, 0.0);
  HostCeilings result;
  result.copy_bytes_per_s =
      2.0 * static_cast<double>(n * threads * sizeof(double)) /
      on_all_threads([&](unsigned t) { std::copy_n(in.data() + t * n, n, out.data() + t * n); });

  constexpr int repeats = 4'000'000;
  std::vector<double> sink(threads);
  const double seconds =
      on_all_threads([&](unsigned t) { sink[t] = multiply_adds(in[0] * 0.999, in[0] * 0.001, t, repeats); });
  result.flops_double = 2.0 * chains * repeats * threads / seconds;
  return result;
}

}  // namespace kreisel::core::device
