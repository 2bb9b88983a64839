#include "micro.hpp"

#include <algorithm>
#include <map>

#include "params.h"

namespace kreisel::core::micro {
namespace {

/// The best of a few: a ceiling is what the machine can do.
template <class Rate>
double best(Rate&& rate) {
  double most = 0;
  for (int i = 0; i < 3; ++i) most = std::max(most, rate());
  return most;
}

void count(benchmark::State& state, double elements, double seconds) {
  state.counters["elements_per_s"] = elements / seconds;
}

}  // namespace

double accumulation(const device::Device& device) { return device.single() ? 10 * 7.0 / KREISEL_RUN : 0; }

bool agree(const Moments& got, const MomentSums& want, double bound, std::size_t n) {
  // The reference's own n roundings outgrow the bound of the kernel's many short sums.
  const double tolerance = bound + static_cast<double>(n) * 0x1p-53;
  return ((got - want.value).cwiseAbs().array() <= tolerance * want.abs_sum.array()).all();
}

void time_kernel(benchmark::State& state, Machine& machine, const std::string& name, double elements,
                 const Floor& floor, const std::function<void()>& launch,
                 const std::function<bool()>& check) {
  static std::map<std::string, bool> agrees;
  const auto [known, first] = agrees.try_emplace(name, false);
  if (first) known->second = check();
  if (!known->second) {
    all_agree = false;
    state.SkipWithError("the kernel differs from its reference by more than its bound");
    return;
  }
  launch();
  device::Probe& probe = machine.probe;
  const double bandwidth = floor.writes ? best([&] { return probe.copy_bytes_per_s(); })
                                        : best([&] { return probe.read_bytes_per_s(); });
  const double flops = best([&] { return probe.flops(); });
  double total = 0;
  for ([[maybe_unused]] auto _ : state) {
    machine.device.reset_kernel_seconds();
    launch();
    const double seconds = machine.device.kernel_seconds();
    state.SetIterationTime(seconds);
    total += seconds;
  }
  const double seconds = total / static_cast<double>(state.iterations());
  count(state, elements, seconds);
  state.counters["bytes_per_s"] = floor.bytes * elements / seconds;
  state.counters["flops"] = floor.flops * elements / seconds;
  state.counters["of_bandwidth"] = floor.bytes * elements / seconds / bandwidth;
  state.counters["of_flops"] = floor.flops * elements / seconds / flops;
  // Could both overlap perfectly, the slower of the two would bind.
  state.counters["share"] = elements * std::max(floor.bytes / bandwidth, floor.flops / flops) / seconds;
}

void time_loop(benchmark::State& state, double elements, double bytes, const std::function<void()>& loop) {
  for ([[maybe_unused]] auto _ : state) loop();
  const auto total = elements * static_cast<double>(state.iterations());
  state.counters["elements_per_s"] = benchmark::Counter(total, benchmark::Counter::kIsRate);
  state.counters["bytes_per_s"] = benchmark::Counter(bytes * total, benchmark::Counter::kIsRate);
}

std::vector<std::size_t> sizes(const device::Device& device, double bytes_an_element) {
  const auto largest =
      static_cast<std::size_t>(static_cast<double>(device::probe_array_bytes(device)) / bytes_an_element);
  std::vector<std::size_t> all = {1'000, 10'000, 100'000, 1'000'000};
  while (all.size() > 1 && all.back() >= largest) all.pop_back();
  all.push_back(largest);
  return all;
}

}  // namespace kreisel::core::micro
