#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "body/body.hpp"
#include "formulation/leaves.hpp"
#include "micro.hpp"

namespace kreisel::core::micro {
namespace {

using Columns10 = Eigen::Matrix<double, 10, Eigen::Dynamic>;

/// Which leaves are cut by a tilted plane through the middle of the grid, as by the surface of a void.
std::vector<std::uint8_t> cut_by_a_plane(const Grid& grid, const Leaves& leaves) {
  const double middle = grid.n[0] / 2.0 + 0.7 * grid.n[1] / 2.0 + 0.4 * grid.n[2] / 2.0;
  std::vector<std::uint8_t> cut;
  cut.reserve(leaves.size());
  for (const Cube& cube : leaves.cubes()) {
    const double half = cube.edge / 2.0;
    const double away = (cube.x + half) + 0.7 * (cube.y + half) + 0.4 * (cube.z + half) - middle;
    cut.push_back(cube.edge > 1 && std::abs(away) <= 2.1 * half);
  }
  return cut;
}

/// The plain loop: the ten moments of each of a leaf's finest cells, one after the other.
void plain_loop(const Columns& domain, const std::vector<std::uint32_t>& first, std::span<const Cube> leaves,
                Columns10& all) {
  const Grid& grid = domain.grid;
  const double h = grid.h, volume = h * h * h, own = h * h / 12;
  all.resize(10, static_cast<Eigen::Index>(leaves.size()));
  for (std::size_t c = 0; c < leaves.size(); ++c) {
    const Cube& cube = leaves[c];
    double s[10] = {};
    for (int iy = cube.y; iy < std::min(cube.y + cube.edge, grid.n[1]); ++iy)
      for (int ix = cube.x; ix < std::min(cube.x + cube.edge, grid.n[0]); ++ix) {
        const std::size_t column = ix + static_cast<std::size_t>(grid.n[0]) * iy;
        const double x = grid.centre(0, ix), y = grid.centre(1, iy);
        for (std::uint32_t r = first[column]; r < first[column + 1]; ++r) {
          const Interval& run = domain.intervals[r];
          const int end = std::min(run.k1, cube.z + cube.edge);
          for (int k = std::max<int>(run.k0, cube.z); k < end; ++k) {
            const double z = grid.centre(2, k);
            s[S1] += 1;
            s[SX] += x;
            s[SY] += y;
            s[SZ] += z;
            s[SXY] += x * y;
            s[SYZ] += y * z;
            s[SXZ] += x * z;
            s[SXX] += x * x + own;
            s[SYY] += y * y + own;
            s[SZZ] += z * z + own;
          }
        }
      }
    for (int k = 0; k < 10; ++k) all(k, static_cast<Eigen::Index>(c)) = volume * s[k];
  }
}

/// An octree as a solve has it in its last round: of half the levels, but voxels along a tilted plane.
class Trial {
 public:
  Trial(const Body& body, int level, device::Device& device)
      : domain_([&] {
          GridSpec spec;
          spec.resolution = 1 << level;
          return make_columns(body, spec, parse_wall("2%"));
        }()),
        first_(first_runs(domain_)),
        leaves_(domain_, device) {
    leaves_.start(edge());
    for (;;) {
      cuts_.push_back(cut_by_a_plane(domain_.grid, leaves_));
      if (std::ranges::find(cuts_.back(), 1) == cuts_.back().end()) break;
      (void)leaves_.split(cuts_.back());
    }
    cuts_.pop_back();
  }

  /// From nothing to the leaves and what each holds; which are to be split is known, as to a solve.
  void build() {
    leaves_.start(edge());
    for (const std::vector<std::uint8_t>& cut : cuts_) (void)leaves_.split(cut);
    sum();
  }
  void sum() { leaves_.moments(moments_); }
  void loop() { plain_loop(domain_, first_, leaves_.cubes(), moments_); }
  void clip() { clipped_ = reference::cell_moments(domain_, leaves_.cubes()); }

  /// The loop's sums of n terms are n roundings off, ours a dozen of each coordinate; lengths are below 2.
  [[nodiscard]] bool agrees() {
    sum();
    const Columns10 ours = moments_;
    loop();
    for (std::size_t c = 0; c < leaves_.size(); ++c) {
      const auto at = static_cast<Eigen::Index>(c);
      const double cells = static_cast<double>(leaves_.voxels(c));
      if (!((ours.col(at) - moments_.col(at)).cwiseAbs().maxCoeff() <=
            4 * (cells + 32) * 0x1p-53 * moments_(S1, at)))
        return false;
    }
    return true;
  }
  [[nodiscard]] const Columns& domain() const { return domain_; }
  [[nodiscard]] std::size_t leaves() const { return leaves_.size(); }

 private:
  /// Of the first leaves, in voxels.
  [[nodiscard]] int edge() const {
    const int levels = octree_levels(domain_.grid);
    return 1 << (levels - levels / 2);
  }

  Columns domain_;
  std::vector<std::uint32_t> first_;
  Leaves leaves_;
  std::vector<std::vector<std::uint8_t>> cuts_;  ///< which leaves are split, round by round
  Columns10 moments_;
  std::vector<Moments> clipped_;
};

}  // namespace

void register_cells(Machine& machine, const std::string& model) {
  BodySpec spec;
  spec.model = model;
  const auto body = std::make_shared<Body>(make_body(spec, machine.device));
  const auto trials = std::make_shared<std::map<int, std::unique_ptr<Trial>>>();
  for (const int level : {6, 7, 8, 9, 10}) {
    const auto add = [&](const char* way, auto run) {
      const std::string name = fmt::format("cell_moments/{}/{}/level{}", way, body->name, level);
      const auto timed = [=, &machine](benchmark::State& state) {
        // Made when first asked for: a domain of the finest level takes longer than all else.
        std::unique_ptr<Trial>& trial = (*trials)[level];
        if (!trial) {
          trial = std::make_unique<Trial>(*body, level, machine.device);
          all_agree = all_agree && trial->agrees();
        }
        for ([[maybe_unused]] auto _ : state) run(*trial);
        state.counters["leaves"] = static_cast<double>(trial->leaves());
        state.counters["cells"] = static_cast<double>(trial->domain().interior_voxels);
      };
      benchmark::RegisterBenchmark(name.c_str(), timed)->Unit(benchmark::kMillisecond)->UseRealTime();
    };
    add("octree", [](Trial& t) { t.build(); });
    add("loop", [](Trial& t) { t.loop(); });
    add("clipped", [](Trial& t) { t.clip(); });
  }
}

}  // namespace kreisel::core::micro
