#include "domain/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "domain/crossings.hpp"
#include "error.hpp"
#include "mesh/distance.hpp"

namespace kreisel {
namespace {

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

/// Calls visit(k) for every cell of the column whose centre has a positive winding number.
template <class Visit>
void for_each_inside(const std::vector<Crossing>& column, const Grid& grid, Visit&& visit) {
  int winding = 0;
  std::size_t next = 0;
  for (int k = 0; k < grid.n[2]; ++k) {
    const double z = grid.centre(2, k);
    for (; next < column.size() && column[next].z <= z; ++next) winding += column[next].winding;
    if (winding > 0) visit(k);
  }
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

Columns make_columns(const Body& body, const GridSpec& spec, const Wall& wall) {
  Columns domain;
  domain.grid = make_grid(bounding_box(body.local), spec);
  const Grid& grid = domain.grid;
  domain.wall = in_body_units(wall, body, grid);
  // The corner of a voxel is half a space diagonal from its centre.
  if (domain.wall < std::sqrt(0.75) * grid.h)
    throw InputError(
        fmt::format("wall {} is {:.2f} cells; expected at least 0.87, so that no void pierces the skin "
                    "(a finer --resolution allows a thinner wall)",
                    to_string(wall), domain.wall / grid.h));

  const auto crossings = column_crossings(body.local, grid);
  const SurfaceDistance distance(body.local);
  // A flat side on the grid puts a whole layer of centres exactly as deep as the wall; round-off must not
  // decide for each of them.
  const double shell = domain.wall - 1e-9 * grid.h;
  for (int iy = 0; iy < grid.n[1]; ++iy)
    for (int ix = 0; ix < grid.n[0]; ++ix) {
      const std::size_t first = domain.intervals.size();
      for_each_inside(crossings[ix + static_cast<std::size_t>(grid.n[0]) * iy], grid, [&](int k) {
        ++domain.inside_voxels;
        const Vec3 centre(grid.centre(0, ix), grid.centre(1, iy), grid.centre(2, k));
        if (distance(centre, shell) < shell) return;
        ++domain.interior_voxels;
        if (domain.intervals.size() > first && domain.intervals.back().k1 == k)
          domain.intervals.back().k1 = k + 1;
        else
          domain.intervals.push_back(
              {static_cast<std::uint16_t>(ix), static_cast<std::uint16_t>(iy), k, k + 1});
      });
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

}  // namespace kreisel
