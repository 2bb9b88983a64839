#include "domain/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "domain/crossings.hpp"
#include "domain/interior.hpp"
#include "error.hpp"
#include "mesh/query/distance.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

/// The domain within a few rows of the grid.
struct RowsOfColumns {
  std::vector<Interval> intervals;
  std::size_t inside_voxels = 0, interior_voxels = 0;
};

RowsOfColumns rows_of_columns(const Grid& grid, const ColumnCrossings& crossings, int first_row,
                              const SurfaceDistance& distance, double shell) {
  RowsOfColumns part;
  CellRows cells(grid, crossings, first_row);
  part.inside_voxels = cells.count();
  cells.remove_shell(distance, shell);
  part.interior_voxels = cells.count();
  for (int iy = cells.first_row(); iy < cells.end_row(); ++iy)
    for (int ix = 0; ix < grid.n[0]; ++ix) {
      const auto column = cells.column(ix, iy);
      for (auto end = column.begin();;) {
        const auto begin = std::find(end, column.end(), 1);
        if (begin == column.end()) break;
        end = std::find(begin, column.end(), 0);
        part.intervals.push_back({static_cast<std::uint16_t>(ix), static_cast<std::uint16_t>(iy),
                                  static_cast<int>(begin - column.begin()),
                                  static_cast<int>(end - column.begin())});
      }
    }
  return part;
}

}  // namespace

Wall parse_wall(const std::string& text) {
  Wall wall;
  const char* end = text.data() + text.size();
  const auto [rest, status] = std::from_chars(text.data(), end, wall.value);
  const std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  const bool known = unit == "h" || unit == "%" || unit.empty() || unit == "mm";
  if (status != std::errc() || !known || !(wall.value > 0) || !std::isfinite(wall.value))
    throw InputError(
        fmt::format("wall '{}'; expected a positive number with h (cells), % (of the longest side) or "
                    "nothing (mm), such as 1.5h",
                    text));
  wall.unit = unit == "h" ? Wall::cells : unit == "%" ? Wall::percent : Wall::millimetres;
  return wall;
}

std::string to_string(const Wall& wall) {
  return fmt::format("{}{}", wall.value,
                     wall.unit == Wall::cells     ? "h"
                     : wall.unit == Wall::percent ? "%"
                                                  : "");
}

double in_body_units(const Wall& wall, const Body& body, const Grid& grid) {
  switch (wall.unit) {
    case Wall::cells:
      return wall.value * grid.h;
    case Wall::percent:
      return wall.value / 100 * bounding_box(body.local).extent().maxCoeff();
    case Wall::millimetres:
      break;
  }
  return wall.value / body.frame.length;
}

Columns make_columns(const Body& body, const GridSpec& spec, const Wall& wall) {
  Columns domain;
  domain.grid = make_grid(bounding_box(body.local), spec);
  const Grid& grid = domain.grid;
  domain.wall = in_body_units(wall, body, grid);
  const double corner = std::sqrt(0.75) * grid.h;  // of a voxel from its centre
  if (!wall.to_corners && domain.wall < corner)
    throw InputError(
        fmt::format("wall {} is {:.2f} cells; expected at least 0.87, so that no void pierces the skin "
                    "(a finer --resolution allows a thinner wall)",
                    to_string(wall), domain.wall / grid.h));

  const auto crossings = column_crossings(body.local, grid);
  const SurfaceDistance distance(body.local);
  // A flat side on the grid puts a whole layer of centres exactly as deep as the wall; round-off must not
  // decide for each of them.
  const double shell = domain.wall + (wall.to_corners ? corner : 0) - 1e-9 * grid.h;
  std::vector<RowsOfColumns> parts(
      static_cast<std::size_t>((grid.n[1] + CellRows::most_rows - 1) / CellRows::most_rows));
  parallel_for(parts.size(), [&](std::size_t i) {
    parts[i] = rows_of_columns(grid, crossings, static_cast<int>(i) * CellRows::most_rows, distance, shell);
  });
  for (const RowsOfColumns& part : parts) {
    domain.intervals.insert(domain.intervals.end(), part.intervals.begin(), part.intervals.end());
    domain.inside_voxels += part.inside_voxels;
    domain.interior_voxels += part.interior_voxels;
  }
  if (domain.intervals.empty())
    throw InputError(
        fmt::format("wall {} leaves no interior in a grid of {} x {} x {}; expected a thinner wall or a "
                    "finer grid",
                    to_string(wall), grid.n[0], grid.n[1], grid.n[2]));
  for (const Interval& run : domain.intervals) {
    const double length = grid.h * (run.k1 - run.k0);
    domain.interior +=
        box_moments({grid.centre(0, run.ix), grid.centre(1, run.iy), grid.face(2, run.k0) + length / 2},
                    {grid.h, grid.h, length});
  }
  return domain;
}

}  // namespace kreisel::core
