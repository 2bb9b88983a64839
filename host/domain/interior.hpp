// interior.hpp - which cells of a solid lie deeper than its wall.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "domain/crossings.hpp"
#include "domain/grid.hpp"
#include "mesh/query/distance.hpp"

namespace kreisel::core {

/// Cells of a few neighbouring rows (all x, all z): first those of the solid, later those of the interior.
class CellRows {
 public:
  static constexpr int most_rows = 8;

  /// The cells whose centres have a positive winding number.
  ///
  /// @param crossings  of every column of the grid (column_crossings)
  /// @param first_row  rows [first_row, first_row + 8), as far as the grid goes
  CellRows(const Grid& grid, const ColumnCrossings& crossings, int first_row);

  /// Takes out every cell whose centre is nearer to the surface than `shell`, exactly as if each were asked.
  ///
  /// A block of cells is asked once, at its centre: a distance changes by no more than the way gone, so a
  /// centre that is farther from the surface than `shell` plus the block's radius keeps the whole block, one
  /// nearer than `shell` less the radius takes it out, and only the blocks between are split.
  void remove_shell(const SurfaceDistance& distance, double shell);

  [[nodiscard]] int first_row() const { return y0_; }
  [[nodiscard]] int end_row() const { return y1_; }
  [[nodiscard]] std::size_t count() const;

  /// One column's cells, 1 or 0 each. iy in [first_row(), end_row()).
  [[nodiscard]] std::span<const std::uint8_t> column(int ix, int iy) const {
    return {cells_.data() + offset(ix, iy), static_cast<std::size_t>(grid_->n[2])};
  }

 private:
  struct Block;
  [[nodiscard]] std::size_t offset(int ix, int iy) const {
    return (static_cast<std::size_t>(iy - y0_) * grid_->n[0] + ix) * grid_->n[2];
  }
  [[nodiscard]] bool any(const Block& block) const;
  void clear(const Block& block);
  void remove_shell(const SurfaceDistance& distance, double shell, const Block& block);

  const Grid* grid_;
  int y0_, y1_;
  std::vector<std::uint8_t> cells_;
};

}  // namespace kreisel::core
