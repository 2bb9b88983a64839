#include "formulation/dense_void.hpp"

namespace kreisel {

DenseVoid::DenseVoid(const VoxelSet& set) : n_(set.domain().grid.n) {
  for (int& n : n_) n += 2;
  cells_.assign(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], 0);
  const auto& intervals = set.domain().intervals;
  for (std::size_t i = 0; i < intervals.size(); ++i)
    for (int k = intervals[i].k0; k < intervals[i].k1; ++k) {
      const std::size_t v = set.first(i) + static_cast<std::size_t>(k - intervals[i].k0);
      cells_[at(intervals[i].ix + 1, intervals[i].iy + 1, k + 1)] = v << 1 | std::uint64_t{!set.solid(v)};
    }
}

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

}  // namespace kreisel
