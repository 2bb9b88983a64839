#include "device/probe.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include "device/buffer.hpp"
#include "device/program.hpp"

namespace kreisel::device {
namespace {

constexpr int launches = 7;

double median_of(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Median device seconds of a launch, after one that is not counted.
double median_seconds(Device& device, const cl::Kernel& kernel, std::size_t items) {
  std::vector<double> seconds;
  for (int i = 0; i <= launches; ++i) {
    device.reset_kernel_seconds();
    device.run(kernel, items, PartialRows::work_group);
    if (i > 0)
      seconds.push_back(device.kernel_seconds());
    else
      device.reset_kernel_seconds();
  }
  return median_of(std::move(seconds));
}

double flop_rate(Device& device, bool single) {
  const cl::Program program = build(device, "probe", single && !device.single() ? "-DKREISEL_SINGLE" : "");
  cl::Kernel kernel(program, "probe_flops");
  const std::size_t items =
      static_cast<std::size_t>(device.info().compute_units) * 64 * (device.info().gpu ? 64 : 4);
  const cl::Buffer out(device.context(), CL_MEM_WRITE_ONLY, items * sizeof(double));
  constexpr int rounds = 10000;  // of 64 multiply-adds, 2 flops each
  kernel.setArg(0, rounds);
  if (single) {
    kernel.setArg(1, 0.999f);
    kernel.setArg(2, 0.001f);
  } else {
    kernel.setArg(1, 0.999);
    kernel.setArg(2, 0.001);
  }
  kernel.setArg(3, out);
  return static_cast<double>(items) * rounds * 64 * 2 / median_seconds(device, kernel, items);
}

/// Seconds of `work(thread)` on every hardware thread at once, median of several.
double on_all_threads(const std::function<void(unsigned)>& work) {
  std::vector<double> seconds;
  for (int i = 0; i <= launches; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    {
      std::vector<std::jthread> threads;
      for (unsigned t = 0; t < std::thread::hardware_concurrency(); ++t) threads.emplace_back(work, t);
    }
    if (i > 0)
      seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return median_of(std::move(seconds));
}

constexpr int chains = 64;

/// `rounds` x `chains` multiply-adds in registers, with the widest vectors this processor has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
double
multiply_adds(double a, double b, unsigned seed, int rounds) {
  double x[chains];
  for (int c = 0; c < chains; ++c) x[c] = c + seed;
  for (int r = 0; r < rounds; ++r)
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

Ceilings measure(Device& device) {
  Ceilings result;
  result.cache_bytes = device.info().cache_bytes ? device.info().cache_bytes : host_cache_bytes();
  const std::size_t wanted = 10 * std::max<std::size_t>(result.cache_bytes, std::size_t{4} << 20);
  result.array_bytes = std::min<std::size_t>(wanted, device.info().memory_bytes / 8) / 4096 * 4096;

  const cl::Program program = build(device, "probe");
  const std::size_t items = result.array_bytes / (4 * device.real_bytes());
  checked("measuring bandwidth", [&] {
    const cl::Buffer in(device.context(), CL_MEM_READ_WRITE, result.array_bytes);
    const cl::Buffer out(device.context(), CL_MEM_READ_WRITE, result.array_bytes);
    device.queue().enqueueFillBuffer(in, 1.0f, 0, result.array_bytes);
    cl::Kernel copy(program, "probe_copy");
    copy.setArg(0, in);
    copy.setArg(1, out);
    result.copy_bytes_per_s =
        2.0 * static_cast<double>(result.array_bytes) / median_seconds(device, copy, items);
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

  constexpr int rounds = 4'000'000;
  std::vector<double> sink(threads);
  const double seconds =
      on_all_threads([&](unsigned t) { sink[t] = multiply_adds(in[0] * 0.999, in[0] * 0.001, t, rounds); });
  result.flops_double = 2.0 * chains * rounds * threads / seconds;
  return result;
}

}  // namespace kreisel::device
