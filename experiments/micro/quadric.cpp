#include <fmt/format.h>

#include <map>
#include <memory>

#include "formulation/quadric_moments.hpp"
#include "formulation/ray_moments.hpp"
#include "micro.hpp"

namespace kreisel::core::micro {
namespace {

/// Intervals in the first octant, most of them cut by cutting(), none of them tangent to it.
const Rays& intervals(std::size_t n) {
  static std::map<std::size_t, Rays> all;
  const auto [at, first] = all.try_emplace(n);
  Rays& rays = at->second;
  if (!first) return rays;
  rays.grid.n = {1024, 1024, 1024};
  rays.grid.origin = {0.1, 0.2, 0.2};
  rays.grid.h = 1e-3;
  for (std::size_t i = 0; i < n; ++i) {
    rays.columns.push_back(pack_column(static_cast<int>(i % 1024), static_cast<int>(i / 1024 % 1024)));
    rays.lower.push_back(0.2 + 2e-3 * static_cast<double>(i % 97));
    rays.upper.push_back(rays.lower.back() + 0.4 + 5e-3 * static_cast<double>(i % 31));
  }
  return rays;
}

Moments cutting() {
  Moments q;
  q << -1, 0.1, 0.05, 1, 0.1, 0.2, 0.1, 0.1, 0.1, 0.2;
  return q;
}

QuadricMoments& kernel_of(Machine& machine, std::size_t n) {
  static std::map<std::pair<Machine*, std::size_t>, std::unique_ptr<QuadricMoments>> all;
  auto& kernel = all[{&machine, n}];
  if (!kernel) kernel = std::make_unique<QuadricMoments>(machine.device, intervals(n));
  return *kernel;
}

/// A root is off by some units of round-off over the slope, here about 1; so is what is summed up at it.
bool agrees(const Support& got, std::size_t n, double roundoff, bool with_hessian) {
  const Rays& rays = intervals(n);
  if (!agree(got.moments, reference::quadric_moments(rays, cutting()), 64 * roundoff, n)) return false;
  if (!with_hessian) return true;
  const Matrix10 want = reference::quadric_hessian(rays, cutting());
  const double tolerance = 64 * roundoff + static_cast<double>(n) * 0x1p-53;
  return (got.hessian - want).cwiseAbs().maxCoeff() <= tolerance * want.cwiseAbs().maxCoeff();
}

}  // namespace

void register_quadric(Machine& machine, bool reference) {
  // Both ends and the column; operations counted in quadric_moments.cl, least and greatest among them.
  const double bytes = 2 * static_cast<double>(machine.device.real_bytes()) + 4;
  const double summing = accumulation(machine.device);
  for (const std::size_t n : sizes(machine.device, bytes))
    for (const bool hessian : {false, true}) {
      const char* kernel = hessian ? "quadric_hessian" : "quadric_moments";
      const Floor floor{bytes, hessian ? 56 + 79 + 4.5 * summing : 56 + summing, false};
      const std::string name = fmt::format("{}/{}/{}", kernel, machine.precision(), n);
      benchmark::RegisterBenchmark(name.c_str(), [&machine, name, n, floor,
                                                  hessian](benchmark::State& state) {
        QuadricMoments& oracle = kernel_of(machine, n);
        time_kernel(
            state, machine, name, static_cast<double>(n), floor, [&] { (void)oracle(cutting(), hessian); },
            [&] { return agrees(oracle(cutting(), hessian), n, machine.device.unit_roundoff(), hessian); });
      })->UseManualTime();
      if (!reference) continue;
      benchmark::RegisterBenchmark(
          fmt::format("{}/loop/{}", kernel, n).c_str(), [n, hessian](benchmark::State& state) {
            const Rays& rays = intervals(n);
            time_loop(state, static_cast<double>(n), 20, [&] {
              benchmark::DoNotOptimize(reference::quadric_moments(rays, cutting()));
              if (hessian) benchmark::DoNotOptimize(reference::quadric_hessian(rays, cutting()));
            });
          });
    }
}

}  // namespace kreisel::core::micro
