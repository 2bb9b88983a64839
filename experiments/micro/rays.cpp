#include <fmt/format.h>

#include <cmath>
#include <map>

#include "formulation/ray_moments.hpp"
#include "micro.hpp"

namespace kreisel::core::micro {
namespace {

/// Rays over a grid in the first octant: with positive weights nothing cancels, so errors are relative.
struct Rays {
  Grid grid;
  std::vector<std::uint32_t> columns;
  std::vector<double> x, out, want;
  Moments weight = Moments::Ones();

  explicit Rays(std::size_t n) {
    grid.n = {1024, 1024, 1024};
    grid.origin = {0.1, 0.2, 0.3};
    grid.h = 1e-3;
    columns.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      columns.push_back(pack_column(static_cast<int>(i % 1024), static_cast<int>(i / 1024 % 1024)));
      const double z0 = 300 + static_cast<double>(i % 97);
      x.insert(x.end(), {z0, z0 + 10 + static_cast<double>(i % 31)});
    }
    out.resize(2 * n);
    want.resize(2 * n);
  }

  [[nodiscard]] double unit() const { return grid.h; }
};

Rays& rays_of(std::size_t n) {
  static std::map<std::size_t, Rays> all;
  return all.try_emplace(n, n).first->second;
}

RayMoments& kernel_of(Machine& machine, std::size_t n) {
  static std::map<std::pair<Machine*, std::size_t>, std::unique_ptr<RayMoments>> all;
  auto& kernel = all[{&machine, n}];
  const Rays& rays = rays_of(n);
  if (!kernel) kernel = std::make_unique<RayMoments>(machine.device, rays.grid, rays.columns, rays.unit());
  return *kernel;
}

/// A dozen roundings on either side of terms of one sign.
bool close(const Rays& rays, double roundoff) {
  for (std::size_t j = 0; j < rays.want.size(); ++j)
    if (!(std::abs(rays.out[j] - rays.want[j]) <= 32 * roundoff * std::abs(rays.want[j]))) return false;
  return true;
}

void sum(benchmark::State& state, Machine& machine, const std::string& name, std::size_t n,
         const Floor& floor) {
  Rays& rays = rays_of(n);
  RayMoments& kernel = kernel_of(machine, n);
  time_kernel(
      state, machine, name, static_cast<double>(n), floor, [&] { (void)kernel(rays.x); },
      [&] {
        const Moments got = kernel(rays.x);
        const MomentSums want = reference::ray_moments(rays.grid, rays.columns, rays.unit(), rays.x);
        return agree(got, want, kernel.bound(), n);
      });
}

void pull_back(benchmark::State& state, Machine& machine, const std::string& name, std::size_t n,
               const Floor& floor) {
  Rays& rays = rays_of(n);
  RayMoments& kernel = kernel_of(machine, n);
  const auto launch = [&] { kernel.pull_back(rays.x, {&rays.weight, 1}, rays.out); };
  time_kernel(state, machine, name, static_cast<double>(n), floor, launch, [&] {
    launch();
    reference::ray_pull_back(rays.grid, rays.columns, rays.unit(), rays.x, rays.weight, rays.want);
    return close(rays, machine.device.unit_roundoff());
  });
}

void curvature(benchmark::State& state, Machine& machine, const std::string& name, std::size_t n,
               const Floor& floor) {
  Rays& rays = rays_of(n);
  RayMoments& kernel = kernel_of(machine, n);
  const auto launch = [&] { kernel.curvature(rays.x, rays.weight, rays.out); };
  time_kernel(state, machine, name, static_cast<double>(n), floor, launch, [&] {
    launch();
    reference::ray_curvature(rays.grid, rays.columns, rays.unit(), rays.x, rays.weight, rays.want);
    return close(rays, machine.device.unit_roundoff());
  });
}

}  // namespace

void register_rays(Machine& machine, bool reference) {
  const double real = static_cast<double>(machine.device.real_bytes());
  // z0, z1 and the column in, two derivatives out; operations counted in ray_moments.cl.
  const Floor summing{2 * real + 4, 30 + accumulation(machine.device), false};
  const Floor pulling{4 * real + 4, 28, true}, curving{4 * real + 4, 14, true};
  for (const std::size_t n : sizes(machine.device, summing.bytes)) {
    const auto add = [&, n](const char* name, auto body, const Floor& floor) {
      const std::string full = fmt::format("{}/{}/{}", name, machine.precision(), n);
      benchmark::RegisterBenchmark(full.c_str(), [&machine, body, full, n, floor](benchmark::State& state) {
        body(state, machine, full, n, floor);
      })->UseManualTime();
    };
    add("ray_moments", sum, summing);
    add("ray_pull_back", pull_back, pulling);
    add("ray_curvature", curvature, curving);
    if (!reference) continue;
    const auto beside = [n](const char* name, double bytes, auto body) {
      benchmark::RegisterBenchmark(fmt::format("{}/loop/{}", name, n).c_str(),
                                   [n, bytes, body](benchmark::State& state) {
                                     Rays& r = rays_of(n);
                                     time_loop(state, static_cast<double>(n), bytes, [&] { body(r); });
                                   });
    };
    beside("ray_moments", 20, [](Rays& r) {
      benchmark::DoNotOptimize(reference::ray_moments(r.grid, r.columns, r.unit(), r.x));
    });
    beside("ray_pull_back", 36,
           [](Rays& r) { reference::ray_pull_back(r.grid, r.columns, r.unit(), r.x, r.weight, r.want); });
    beside("ray_curvature", 36,
           [](Rays& r) { reference::ray_curvature(r.grid, r.columns, r.unit(), r.x, r.weight, r.want); });
  }
}

}  // namespace kreisel::core::micro
