// flip_delaunay.hpp - better triangles for a plane region that is cut into some.
#pragma once

#include <array>

#include "geometry/polygon.hpp"

namespace kreisel::core {

/// Turns edges inside the region until none has a corner opposite within the circle through the triangle on
/// its other side: the constrained Delaunay triangulation [Lawson 1977], up to rounding where four points lie
/// on a circle. Three neighbours that lie nearly on one line, as along a cut, then make no triangle of their
/// own as long as any other corner can be seen from them.
///
/// @param triangles  counter-clockwise by exact signs, no edge of more than two; stays so
void flip_to_delaunay(std::span<const Vec2> points, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace kreisel::core
