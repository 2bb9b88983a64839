#include "formulation/voxel_set.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace kreisel {

VoxelSet::VoxelSet(const Columns& domain, bool solid)
    : domain_(&domain), solid_(domain.interior_voxels, solid) {
  std::size_t next = 0;
  for (const Interval& run : domain.intervals) {
    first_.push_back(next);
    next += static_cast<std::size_t>(run.k1 - run.k0);
  }
}

std::size_t VoxelSet::count_solid() const {
  return std::accumulate(solid_.begin(), solid_.end(), std::size_t{0});
}

Moments moments(const VoxelSet& set) {
  const Columns& domain = set.domain();
  const Grid& grid = domain.grid;
  const Vec3 cell = Vec3::Constant(grid.h);
  Moments sum = Moments::Zero();
  for (std::size_t i = 0; i < domain.intervals.size(); ++i) {
    const Interval& run = domain.intervals[i];
    for (int k = run.k0; k < run.k1; ++k)
      if (set.solid(set.first(i) + static_cast<std::size_t>(k - run.k0)))
        sum += box_moments({grid.centre(0, run.ix), grid.centre(1, run.iy), grid.centre(2, k)}, cell);
  }
  return sum;
}

namespace {

/// Void flags on a dense grid with a layer of solid around it.
class DenseVoid {
 public:
  explicit DenseVoid(const VoxelSet& set) : n_(set.domain().grid.n) {
    for (int& n : n_) n += 2;
    voxel_.assign(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], solid);
    const auto& intervals = set.domain().intervals;
    for (std::size_t i = 0; i < intervals.size(); ++i)
      for (int k = intervals[i].k0; k < intervals[i].k1; ++k) {
        const std::size_t v = set.first(i) + static_cast<std::size_t>(k - intervals[i].k0);
        if (!set.solid(v))
          voxel_[at(intervals[i].ix + 1, intervals[i].iy + 1, k + 1)] = static_cast<std::int64_t>(v);
      }
  }

  static constexpr std::int64_t solid = -1;

  [[nodiscard]] std::size_t at(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * n_[1] + y) * n_[0] + x;
  }
  [[nodiscard]] const std::array<int, 3>& n() const { return n_; }
  /// Index of a void voxel in its set, or `solid`.
  [[nodiscard]] std::int64_t& operator[](std::size_t cell) { return voxel_[cell]; }

 private:
  std::array<int, 3> n_;
  std::vector<std::int64_t> voxel_;
};

/// Bit c of a block is set when its corner cell (c&1, c>>1&1, c>>2) is void.
/// A void cell to fill, or -1 when the surface is a manifold at the block's middle.
int offending_corner(unsigned block) {
  static constexpr std::array<std::array<int, 4>, 6> faces = {
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  const auto is_void = [block](int c) { return (block >> c & 1u) != 0; };
  for (const auto& f : faces) {  // corners in a ring: a diagonal pair of each kind means a pinched edge
    if (is_void(f[0]) && is_void(f[2]) && !is_void(f[1]) && !is_void(f[3])) return f[0];
    if (is_void(f[1]) && is_void(f[3]) && !is_void(f[0]) && !is_void(f[2])) return f[1];
  }
  for (int c = 0; c < 4; ++c) {  // opposite corners alone: a pinched point
    const unsigned pair = 1u << c | 1u << (7 - c);
    if (block == pair) return c;
    if (block == (0xffu & ~pair)) return (c + 1) % 8 == 7 - c ? (c + 2) % 8 : (c + 1) % 8;
  }
  return -1;
}

}  // namespace

std::size_t make_well_composed(VoxelSet& set) {
  DenseVoid cells(set);
  const auto& n = cells.n();
  std::size_t filled = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (int z = 0; z + 1 < n[2]; ++z)
      for (int y = 0; y + 1 < n[1]; ++y)
        for (int x = 0; x + 1 < n[0]; ++x) {
          const auto corner = [&](int c) { return cells.at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)); };
          unsigned block = 0;
          for (int c = 0; c < 8; ++c)
            block |= static_cast<unsigned>(cells[corner(c)] != DenseVoid::solid) << c;
          for (int c; (c = offending_corner(block)) >= 0; block &= ~(1u << c)) {
            set.set(static_cast<std::size_t>(cells[corner(c)]), true);
            cells[corner(c)] = DenseVoid::solid;
            ++filled;
            changed = true;
          }
        }
  }
  return filled;
}

}  // namespace kreisel
