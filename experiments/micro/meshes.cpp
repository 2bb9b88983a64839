#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "body/mesh_moments.hpp"
#include "micro.hpp"

namespace kreisel::core::micro {
namespace {

/// A torus of about n triangles.
TriangleMesh torus(std::size_t n) {
  const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(n) / 2));
  const double step = 2 * std::numbers::pi / side;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j) {
      const double u = i * step, v = j * step, r = 1 + 0.4 * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
      const std::uint32_t i1 = (i + 1) % side, j1 = (j + 1) % side;
      mesh.triangles.push_back({i * side + j, i1 * side + j, i1 * side + j1});
      mesh.triangles.push_back({i * side + j, i1 * side + j1, i * side + j1});
    }
  return mesh;
}

const TriangleMesh& torus_of(std::size_t n) {
  static std::map<std::size_t, TriangleMesh> all;
  auto& mesh = all[n];
  if (mesh.triangles.empty()) mesh = torus(n);
  return mesh;
}

}  // namespace

void register_meshes(Machine& machine, bool reference) {
  const double real = static_cast<double>(machine.device.real_bytes());
  // Three corners, and half a vertex of four reals, for a vertex belongs to six triangles.
  // Operations counted in mesh_moments.cl.
  const Floor floor{12 + 2 * real, 81 + accumulation(machine.device), false};
  for (const std::size_t n : sizes(machine.device, floor.bytes)) {
    const std::string name = fmt::format("mesh_moments/{}/{}", machine.precision(), n);
    benchmark::RegisterBenchmark(name.c_str(), [&machine, name, floor, n](benchmark::State& state) {
      const TriangleMesh& mesh = torus_of(n);
      time_kernel(
          state, machine, name, static_cast<double>(mesh.triangles.size()), floor,
          [&] { (void)mesh_moments(mesh, machine.device); },
          [&] {
            const Moments got = mesh_moments(mesh, machine.device);
            // The torus lies about the origin, so nothing was moved.
            const MomentSums want = reference::mesh_moments(mesh);
            const double bound = mesh_moments_bound(mesh, machine.device);
            return agree(got, want, bound, n);
          });
    })->UseManualTime();
    if (!reference) continue;
    benchmark::RegisterBenchmark(
        fmt::format("mesh_moments/loop/{}", n).c_str(), [n](benchmark::State& state) {
          const TriangleMesh& mesh = torus_of(n);
          time_loop(state, static_cast<double>(mesh.triangles.size()), 24,
                    [&] { benchmark::DoNotOptimize(reference::mesh_moments(mesh)); });
        });
  }
}

}  // namespace kreisel::core::micro
