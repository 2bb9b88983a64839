// exact.hpp - the interior as vertical intervals with real ends.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/columns.hpp"

namespace kreisel::core {

/// A maximal part of a column's centre line in the interior: z0 < z1, body units.
struct ExactInterval {
  std::uint16_t ix, iy;
  double z0, z1;
};

/// Interior of a body as rays along z, cut exactly: a point belongs to it when it lies inside the mesh and no
/// nearer to the surface than the wall. A ray stands for an h x h column, as in Columns; the sum over the
/// rays converges to the integral over the interior as the grid gets finer.
struct ExactColumns {
  Grid grid;                             ///< that of make_columns
  double wall = 0;                       ///< body units
  std::vector<ExactInterval> intervals;  ///< by iy, then ix, then z0
  Moments interior = Moments::Zero();    ///< of all h x h columns at unit density, body units
};

/// The parts of the centre lines of a grid's columns inside a mesh and at least `wall` from its surface: the
/// crossings of the surface (crossings.hpp) less its exact offset (mesh/query/offset.hpp). Every point is as
/// deep as the wall up to round-off; sorted as in ExactColumns.
///
/// @param wall  >= 0, the mesh's unit
/// @throws InputError  a mesh that is not closed
[[nodiscard]] std::vector<ExactInterval> exact_intervals(const TriangleMesh& mesh, const Grid& grid,
                                                         double wall);

/// The exact_intervals of a body on the grid of make_columns. Any wall > 0 will do.
///
/// @throws InputError  no interior left; a mesh that is not closed
[[nodiscard]] ExactColumns make_exact(const Body& body, const GridSpec& spec, const Wall& wall);

}  // namespace kreisel::core
