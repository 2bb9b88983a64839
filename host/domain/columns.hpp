// columns.hpp - the domain of the papers: interior voxels, and the rays through them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "body/body.hpp"
#include "domain/grid.hpp"

namespace kreisel::core {

/// Least distance of the interior from the surface.
struct Wall {
  double value = 1.5;
  enum Unit { cells, millimetres, percent } unit = cells;  ///< percent of the longest side of the body
  /// Whether a voxel must keep it with all of itself; with its centre otherwise, as in the papers.
  bool to_corners = false;

  bool operator==(const Wall&) const = default;
};

/// "1.5h" (cells), "2%" (of the longest side) or "1.2" (mm).
///
/// @throws InputError  anything else, or not > 0
[[nodiscard]] Wall parse_wall(const std::string& text);
[[nodiscard]] std::string to_string(const Wall& wall);
/// The wall's thickness for a body and its grid, body units.
[[nodiscard]] double in_body_units(const Wall& wall, const Body& body, const Grid& grid);

/// A maximal run of interior voxels along a column: cells [k0, k1).
struct Interval {
  std::uint16_t ix, iy;
  int k0, k1;
};

/// Interior of a body as voxels and as rays along z. [RayRep, s. 3.4]
///
/// A voxel belongs to the solid when its centre is inside the mesh, and to the shell when its centre is
/// nearer to the surface than the wall (or any of it may be: Wall::to_corners); the rest is interior. A ray
/// stands for an h x h column, so voxels and rays describe the same set.
struct Columns {
  Grid grid;
  double wall = 0;  ///< body units
  std::vector<Interval> intervals;
  std::size_t inside_voxels = 0;  ///< of the solid, shell included
  std::size_t interior_voxels = 0;
  Moments interior = Moments::Zero();  ///< of all interior voxels at unit density, body units
};

/// @throws InputError  a wall to centres under 0.87 cells (a void's corner could pierce the skin), or no
///                     interior left
[[nodiscard]] Columns make_columns(const Body& body, const GridSpec& spec, const Wall& wall);

}  // namespace kreisel::core
