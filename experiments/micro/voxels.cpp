#include <fmt/format.h>

#include <cmath>
#include <map>

#include "formulation/voxel_moments.hpp"
#include "micro.hpp"

namespace kreisel::core::micro {
namespace {

/// Voxels of a grid in the first octant: with positive weights nothing cancels, so errors are relative.
struct Voxels {
  Grid grid;
  std::vector<std::uint32_t> cells;
  std::vector<double> fill, out, want;
  Moments weight = Moments::Ones();

  explicit Voxels(std::size_t n) : out(n), want(n) {
    grid.n = {1024, 1024, 1024};
    grid.origin = {0.1, 0.2, 0.3};
    grid.h = 1e-3;
    for (std::size_t i = 0; i < n; ++i) {
      const int z = static_cast<int>(i % 1024), x = static_cast<int>(i / 1024 % 1024);
      cells.push_back(pack_cell(x, static_cast<int>(i / 1048576 % 1024), z));
      fill.push_back(static_cast<double>(i % 97) / 96);
    }
  }
};

Voxels& voxels_of(std::size_t n) {
  static std::map<std::size_t, Voxels> all;
  return all.try_emplace(n, n).first->second;
}

VoxelMoments& kernel_of(Machine& machine, std::size_t n) {
  static std::map<std::pair<Machine*, std::size_t>, std::unique_ptr<VoxelMoments>> all;
  auto& kernel = all[{&machine, n}];
  if (!kernel) kernel = std::make_unique<VoxelMoments>(machine.device, voxels_of(n).grid, voxels_of(n).cells);
  return *kernel;
}

void sum(benchmark::State& state, Machine& machine, const std::string& name, std::size_t n,
         const Floor& floor) {
  Voxels& voxels = voxels_of(n);
  VoxelMoments& kernel = kernel_of(machine, n);
  time_kernel(
      state, machine, name, static_cast<double>(n), floor, [&] { (void)kernel(voxels.fill); },
      [&] {
        const Moments got = kernel(voxels.fill);
        const MomentSums want = reference::voxel_moments(voxels.grid, voxels.cells, voxels.fill);
        return agree(got, want, kernel.bound(), n);
      });
}

void pull_back(benchmark::State& state, Machine& machine, const std::string& name, std::size_t n,
               const Floor& floor) {
  Voxels& voxels = voxels_of(n);
  VoxelMoments& kernel = kernel_of(machine, n);
  const auto launch = [&] { kernel.pull_back({&voxels.weight, 1}, voxels.out); };
  time_kernel(state, machine, name, static_cast<double>(n), floor, launch, [&] {
    launch();
    reference::voxel_pull_back(voxels.grid, voxels.cells, voxels.weight, voxels.want);
    // Two dozen roundings on either side of terms of one sign.
    for (std::size_t i = 0; i < n; ++i)
      if (!(std::abs(voxels.out[i] - voxels.want[i]) <= 48 * machine.device.unit_roundoff() * voxels.want[i]))
        return false;
    return true;
  });
}

}  // namespace

void register_voxels(Machine& machine, bool reference) {
  const double real = static_cast<double>(machine.device.real_bytes());
  // Fill and cell in; or the cell in and a derivative out. Operations counted in voxel_moments.cl.
  const Floor summing{real + 4, 25 + accumulation(machine.device), false};
  const Floor pulling{real + 4, 24, true};
  for (const std::size_t n : sizes(machine.device, summing.bytes)) {
    const auto add = [&, n](const char* name, auto body, const Floor& floor) {
      const std::string full = fmt::format("{}/{}/{}", name, machine.precision(), n);
      benchmark::RegisterBenchmark(full.c_str(), [&machine, body, full, n, floor](benchmark::State& state) {
        body(state, machine, full, n, floor);
      })->UseManualTime();
    };
    add("voxel_moments", sum, summing);
    add("voxel_pull_back", pull_back, pulling);
    if (!reference) continue;
    benchmark::RegisterBenchmark(
        fmt::format("voxel_moments/loop/{}", n).c_str(), [n](benchmark::State& state) {
          const Voxels& v = voxels_of(n);
          time_loop(state, static_cast<double>(n), 12,
                    [&] { benchmark::DoNotOptimize(reference::voxel_moments(v.grid, v.cells, v.fill)); });
        });
    benchmark::RegisterBenchmark(
        fmt::format("voxel_pull_back/loop/{}", n).c_str(), [n](benchmark::State& state) {
          Voxels& v = voxels_of(n);
          time_loop(state, static_cast<double>(n), 12,
                    [&] { reference::voxel_pull_back(v.grid, v.cells, v.weight, v.want); });
        });
  }
}

}  // namespace kreisel::core::micro
