// exact.hpp - the interior as vertical intervals with real ends.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "domain/columns.hpp"
#include "mesh/query/offset.hpp"

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

/// What every wall's exact intervals are cut from: the centre lines of a grid's columns inside a mesh, and
/// the pieces of its surface.
class SolidLines {
 public:
  /// @throws InputError  a mesh that is not closed
  SolidLines(const TriangleMesh& mesh, const Grid& grid);

  [[nodiscard]] const Grid& grid() const { return grid_; }

  /// The parts of the lines at least `wall` from the surface: its crossings (crossings.hpp) less its exact
  /// offset (mesh/query/offset.hpp). Every point is as deep as the wall up to round-off; sorted as in
  /// ExactColumns. From several threads at once, too.
  ///
  /// @param wall  >= 0, the mesh's unit
  [[nodiscard]] std::vector<ExactInterval> intervals(double wall) const;

 private:
  Grid grid_;
  double round_off_;  ///< of a depth
  LineSpans inside_;
  std::optional<ShellPieces> pieces_;
};

/// Those of a body on the grid of make_columns. @throws InputError  a mesh that is not closed
[[nodiscard]] SolidLines solid_lines(const Body& body, const GridSpec& spec);

/// The intervals of a body. Any wall > 0 will do.
///
/// @param lines  of this body
/// @throws InputError  no interior left
[[nodiscard]] ExactColumns make_exact(const Body& body, const SolidLines& lines, const Wall& wall);

/// The same for one wall alone. @throws InputError  no interior left; a mesh that is not closed
[[nodiscard]] ExactColumns make_exact(const Body& body, const GridSpec& spec, const Wall& wall);

}  // namespace kreisel::core
