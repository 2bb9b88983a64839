#include "formulation/voxel_set.hpp"

#include <numeric>

#include "formulation/dense_void.hpp"

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
          unsigned block = cells.block(x, y, z);
          for (int c; (c = offending_corner(block)) >= 0; block &= ~(1u << c)) {
            set.set(cells.voxel(corner(c)), true);
            cells.set_void(corner(c), false);
            ++filled;
            changed = true;
          }
        }
  }
  return filled;
}

}  // namespace kreisel
