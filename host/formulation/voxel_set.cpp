#include "formulation/voxel_set.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>

#include "formulation/dense_void.hpp"

namespace kreisel::core {

VoxelSet::VoxelSet(const Columns& domain, bool solid)
    : domain_(&domain), solid_(domain.interior_voxels, solid) {
  std::size_t next = 0;
  for (const Interval& run : domain.intervals) {
    first_.push_back(next);
    next += static_cast<std::size_t>(run.k1 - run.k0);
  }
}

void VoxelSet::set(std::size_t voxel, std::size_t count, bool solid) {
  std::fill_n(solid_.begin() + static_cast<std::ptrdiff_t>(voxel), count, std::uint8_t{solid});
}

std::size_t VoxelSet::count_solid() const {
  return std::accumulate(solid_.begin(), solid_.end(), std::size_t{0});
}

Moments moments(const VoxelSet& set) {
  const Columns& domain = set.domain();
  const Grid& grid = domain.grid;
  Moments sum = Moments::Zero();
  for (std::size_t i = 0; i < domain.intervals.size(); ++i) {
    const Interval& run = domain.intervals[i];
    const std::size_t first = set.first(i), end = first + static_cast<std::size_t>(run.k1 - run.k0);
    for (std::size_t v = first, next; v < end; v = next) {
      next = set.next_change(v, end);
      if (!set.solid(v)) continue;
      const double length = grid.h * static_cast<double>(next - v);
      sum += box_moments({grid.centre(0, run.ix), grid.centre(1, run.iy),
                          grid.face(2, run.k0 + static_cast<int>(v - first)) + length / 2},
                         {grid.h, grid.h, length});
    }
  }
  return sum;
}

std::size_t VoxelSet::next_change(std::size_t voxel, std::size_t end) const {
  const void* found = std::memchr(solid_.data() + voxel, solid_[voxel] == 0, end - voxel);
  return found ? static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - solid_.data()) : end;
}

std::size_t VoxelSet::at(int ix, int iy, int k) const {
  // Columns come in order, and the runs of each upwards.
  const auto& intervals = domain_->intervals;
  const auto run = std::ranges::lower_bound(intervals, std::tuple(iy, ix, k), {}, [](const Interval& i) {
    return std::tuple<int, int, int>(i.iy, i.ix, i.k1 - 1);
  });
  return first_[static_cast<std::size_t>(run - intervals.begin())] + static_cast<std::size_t>(k - run->k0);
}

std::size_t make_well_composed(VoxelSet& set) {
  DenseVoid cells(set);
  const auto& n = cells.n();
  std::size_t filled = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (int z = 0; z + 1 < n[2]; ++z)
      for (int y = 0; y + 1 < n[1]; ++y)
        for (int x = 0; (x = cells.next_mixed_block(x, y, z)) < n[0]; ++x) {
          unsigned block = cells.block(x, y, z);
          for (int c; (c = offending_corner(block)) >= 0; block &= ~(1u << c)) {
            const int at[] = {x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)};
            set.set(set.at(at[0] - 1, at[1] - 1, at[2] - 1), true);
            cells.set_void(at[0], at[1], at[2], false);
            ++filled;
            changed = true;
          }
        }
  }
  return filled;
}

}  // namespace kreisel::core
