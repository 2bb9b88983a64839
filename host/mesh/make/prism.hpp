// prism.hpp - upright prisms: axles, pins, and shapes of the plane in space.
#pragma once

#include "geometry/polygon.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The closed prism over a polygon, counter-clockwise seen from above, from z = bottom to z = top.
/// @throws InputError  a polygon that crosses itself
[[nodiscard]] TriangleMesh prism(std::span<const Vec2> polygon, double bottom, double top);

}  // namespace kreisel::core
