#include "domain/interior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace kreisel::core {
namespace {

constexpr int block_edge = 8;

}  // namespace

/// Cells [lo, hi) along each axis.
struct CellRows::Block {
  std::array<int, 3> lo, hi;

  [[nodiscard]] Vec3 centre(const Grid& grid) const {
    return {(grid.centre(0, lo[0]) + grid.centre(0, hi[0] - 1)) / 2,
            (grid.centre(1, lo[1]) + grid.centre(1, hi[1] - 1)) / 2,
            (grid.centre(2, lo[2]) + grid.centre(2, hi[2] - 1)) / 2};
  }
  /// From the centre to the farthest centre of a cell.
  [[nodiscard]] double radius(const Grid& grid) const {
    return grid.h / 2 * std::hypot(hi[0] - lo[0] - 1, hi[1] - lo[1] - 1, hi[2] - lo[2] - 1);
  }
  [[nodiscard]] bool one_cell() const {
    return hi[0] - lo[0] == 1 && hi[1] - lo[1] == 1 && hi[2] - lo[2] == 1;
  }
};

CellRows::CellRows(const Grid& grid, const ColumnCrossings& crossings, int first_row)
    : grid_(&grid),
      y0_(first_row),
      y1_(std::min(first_row + most_rows, grid.n[1])),
      cells_(static_cast<std::size_t>(y1_ - y0_) * grid.n[0] * grid.n[2]) {
  for (int iy = y0_; iy < y1_; ++iy)
    for (int ix = 0; ix < grid.n[0]; ++ix) {
      const std::span<const Crossing> column = crossings[ix + static_cast<std::size_t>(grid.n[0]) * iy];
      if (column.empty()) continue;
      std::uint8_t* cell = cells_.data() + offset(ix, iy);
      int winding = 0;
      std::size_t next = 0;
      for (int k = 0; k < grid.n[2]; ++k) {
        const double z = grid.centre(2, k);
        for (; next < column.size() && column[next].z <= z; ++next) winding += column[next].winding;
        cell[k] = winding > 0;
      }
    }
}

std::size_t CellRows::count() const { return std::ranges::count(cells_, std::uint8_t{1}); }

bool CellRows::any(const Block& b) const {
  for (int iy = b.lo[1]; iy < b.hi[1]; ++iy)
    for (int ix = b.lo[0]; ix < b.hi[0]; ++ix)
      if (std::memchr(cells_.data() + offset(ix, iy) + b.lo[2], 1,
                      static_cast<std::size_t>(b.hi[2] - b.lo[2])))
        return true;
  return false;
}

void CellRows::clear(const Block& b) {
  for (int iy = b.lo[1]; iy < b.hi[1]; ++iy)
    for (int ix = b.lo[0]; ix < b.hi[0]; ++ix)
      std::memset(cells_.data() + offset(ix, iy) + b.lo[2], 0, static_cast<std::size_t>(b.hi[2] - b.lo[2]));
}

void CellRows::remove_shell(const SurfaceDistance& distance, double shell) {
  for (int ix = 0; ix < grid_->n[0]; ix += block_edge)
    for (int k = 0; k < grid_->n[2]; k += block_edge)
      remove_shell(distance, shell,
                   {{ix, y0_, k},
                    {std::min(ix + block_edge, grid_->n[0]), y1_, std::min(k + block_edge, grid_->n[2])}});
}

void CellRows::remove_shell(const SurfaceDistance& distance, double shell, const Block& b) {
  if (!any(b)) return;
  const Vec3 centre = b.centre(*grid_);
  if (b.one_cell()) {
    if (distance(centre, shell, shell) < shell) clear(b);
    return;
  }
  // Far above what round-off does to a distance, so that a block never speaks for a cell it is not sure of.
  const double reach = b.radius(*grid_) + 1e-3 * grid_->h;
  const double depth = distance(centre, shell + reach, shell - reach);
  if (depth >= shell + reach) return;
  if (depth < shell - reach) {
    clear(b);
    return;
  }
  // Halves along every axis; an axis of one cell stays whole.
  const auto middle = [&](int axis) { return (b.lo[axis] + b.hi[axis] + 1) / 2; };
  const std::array<int, 3> mid = {middle(0), middle(1), middle(2)};
  for (int part = 0; part < 8; ++part) {
    Block child = b;
    for (int axis = 0; axis < 3; ++axis) (part >> axis & 1 ? child.lo : child.hi)[axis] = mid[axis];
    if (child.lo[0] < child.hi[0] && child.lo[1] < child.hi[1] && child.lo[2] < child.hi[2])
      remove_shell(distance, shell, child);
  }
}

}  // namespace kreisel::core
