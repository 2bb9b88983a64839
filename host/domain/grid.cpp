#include "domain/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.hpp"

namespace kreisel::core {
namespace {

void require_count(int n, const char* what) {
  if (n >= 2 && n <= Grid::most_cells) return;
  // A column's crossings are the least that a domain keeps: a list and two entries.
  constexpr double column_bytes = 56, gibi = 1 << 30;
  const std::string need =
      n < 2 ? "" : fmt::format(" (the columns alone would need {:.3g} GiB)", column_bytes * n * n / gibi);
  throw InputError(fmt::format("{} of {} cells{}; expected 2 to {}", what, n, need, Grid::most_cells));
}

}  // namespace

Grid make_grid(const Box& box, const GridSpec& spec) {
  const Vec3 extent = box.extent();
  Grid grid;
  if (spec.cells) {
    grid.n = *spec.cells;
    for (const int n : grid.n) require_count(n, "grid");
    // Cubes that hold the whole box: the tightest direction sets the edge.
    for (int a = 0; a < 3; ++a) grid.h = std::max(grid.h, extent[a] / grid.n[a]);
  } else {
    require_count(spec.resolution, "resolution");
    grid.h = extent.maxCoeff() / spec.resolution;
    // A side that is a whole number of cells but for round-off must not gain a cell.
    for (int a = 0; a < 3; ++a)
      grid.n[a] = std::max(1, static_cast<int>(std::ceil(extent[a] / grid.h - 1e-9)));
  }
  const Vec3 middle = box.centre();
  for (int a = 0; a < 3; ++a) grid.origin[a] = middle[a] - grid.h * grid.n[a] / 2;
  return grid;
}

}  // namespace kreisel::core
