#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "body/body.hpp"
#include "formulation/cell_moments.hpp"
#include "micro.hpp"

namespace kreisel::micro {
namespace {

/// Leaves as an octree's solve has them in its last round: of half the levels, but voxels along a tilted
/// plane.
std::vector<Cube> leaves_along_a_plane(const Grid& grid) {
  const int levels = octree_levels(grid);
  std::vector<Cube> done, open = uniform_cubes(grid, 1 << (levels - levels / 2));
  const double middle = grid.n[0] / 2.0 + 0.7 * grid.n[1] / 2.0 + 0.4 * grid.n[2] / 2.0;
  while (!open.empty()) {
    const Cube cube = open.back();
    open.pop_back();
    const double half = cube.edge / 2.0;
    const double away = (cube.x + half) + 0.7 * (cube.y + half) + 0.4 * (cube.z + half) - middle;
    if (cube.x >= grid.n[0] || cube.y >= grid.n[1] || cube.z >= grid.n[2]) continue;
    if (cube.edge == 1 || std::abs(away) > 2.1 * half)
      done.push_back(cube);
    else
      for (int part = 0; part < 8; ++part) open.push_back(cube.child(part));
  }
  std::ranges::sort(done, {}, place_on_curve);
  return done;
}

struct Tree {
  Columns domain;
  std::vector<Cube> leaves;
  CellMoments kernel;

  Tree(const Body& body, int level, device::Device& device)
      : domain([&] {
          GridSpec spec;
          spec.resolution = 1 << level;
          return make_columns(body, spec, parse_wall("2%"));
        }()),
        leaves(leaves_along_a_plane(domain.grid)),
        kernel(device, domain) {}

  [[nodiscard]] std::vector<Moments> sums() {
    const std::vector<CubeSums> whole = kernel(leaves);
    std::vector<Moments> all(leaves.size());
    for (std::size_t c = 0; c < leaves.size(); ++c) all[c] = moments_of(domain.grid, leaves[c], whole[c]);
    return all;
  }

  /// Both are exact but for the roundings of coordinates about a unit.
  [[nodiscard]] bool agree() {
    const std::vector<Moments> got = sums(), want = reference::cell_moments(domain, leaves);
    for (std::size_t c = 0; c < leaves.size(); ++c)
      if (!((got[c] - want[c]).cwiseAbs().maxCoeff() <= 1e-12 * want[c][S1])) return false;
    return true;
  }
};

}  // namespace

void register_cells(Machine& machine, const std::string& model) {
  BodySpec spec;
  spec.model = model;
  const Body body = make_body(spec, machine.device);
  for (const int level : {7, 8, 9}) {
    const auto tree = std::make_shared<Tree>(body, level, machine.device);
    all_agree = all_agree && tree->agree();
    const auto add = [&](const char* way, auto run) {
      const std::string name = fmt::format("cell_moments/{}/{}/level{}", way, body.name, level);
      benchmark::RegisterBenchmark(name.c_str(),
                                   [run, tree](benchmark::State& state) {
                                     for ([[maybe_unused]] auto _ : state) run(*tree);
                                     state.counters["leaves"] = static_cast<double>(tree->leaves.size());
                                   })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    };
    add("device", [](Tree& t) { benchmark::DoNotOptimize(t.sums()); });
    add("loop", [](Tree& t) { benchmark::DoNotOptimize(reference::cell_moments(t.domain, t.leaves)); });
  }
}

}  // namespace kreisel::micro
