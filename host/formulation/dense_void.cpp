#include "formulation/dense_void.hpp"

#include <algorithm>
#include <bit>

namespace kreisel::core {

DenseVoid::DenseVoid(const VoxelSet& set) : n_(set.domain().grid.n) {
  for (int& n : n_) n += 2;
  words_ = static_cast<std::size_t>(n_[0]) / 64 + 2;
  bits_.assign(words_ * n_[1] * n_[2], 0);
  const auto& intervals = set.domain().intervals;
  for (std::size_t i = 0; i < intervals.size(); ++i)
    for (int k = intervals[i].k0; k < intervals[i].k1; ++k)
      if (!set.solid(set.first(i) + static_cast<std::size_t>(k - intervals[i].k0)))
        set_void(intervals[i].ix + 1, intervals[i].iy + 1, k + 1, true);
}

int DenseVoid::next_mixed_block(int x, int y, int z) const {
  const std::array<const std::uint64_t*, 4> rows = {row(y, z), row(y + 1, z), row(y, z + 1),
                                                    row(y + 1, z + 1)};
  std::uint64_t wanted = ~std::uint64_t{0} << x % 64;
  for (std::size_t w = static_cast<std::size_t>(x) / 64; w + 1 < words_; ++w, wanted = ~std::uint64_t{0}) {
    std::uint64_t any = 0, all = ~std::uint64_t{0};
    for (const std::uint64_t* r : rows) {
      const std::uint64_t here = r[w], beside = here >> 1 | r[w + 1] << 63;
      any |= here | beside;
      all &= here & beside;
    }
    if (const std::uint64_t mixed = any & ~all & wanted; mixed != 0)
      return std::min(static_cast<int>(64 * w) + std::countr_zero(mixed), n_[0]);
  }
  return n_[0];
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

}  // namespace kreisel::core
