// grid.hpp - a uniform grid of cubic cells over a body's bounding box.
#pragma once

#include <array>
#include <optional>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// How fine: cells along the longest side, or the whole grid as the papers print it.
struct GridSpec {
  int resolution = 64;                      ///< cells along the longest side of the bounding box
  std::optional<std::array<int, 3>> cells;  ///< the grid itself; the box is centred in it

  bool operator==(const GridSpec&) const = default;
};

/// Cells [0,nx) x [0,ny) x [0,nz) of edge h; `origin` is the corner of cell (0,0,0). Body units.
struct Grid {
  static constexpr int most_cells = 1024;  ///< along an axis: voxel_moments.cl packs an index into 10 bits

  std::array<int, 3> n{};
  Vec3 origin = Vec3::Zero();
  double h = 0;

  [[nodiscard]] double centre(int axis, int i) const { return origin[axis] + h * (i + 0.5); }
  [[nodiscard]] double face(int axis, int i) const { return origin[axis] + h * i; }
};

/// The grid of `spec` over `box`: cubic cells, the box centred.
///
/// @throws InputError  a count outside [2, 1024]
[[nodiscard]] Grid make_grid(const Box& box, const GridSpec& spec);

}  // namespace kreisel::core
