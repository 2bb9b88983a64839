// prism.hpp - upright prisms and the circles they stand on: axles, pins, and the holes for both.
#pragma once

#include <vector>

#include "geometry/fill_polygon.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A regular polygon with its corners on the circle, counter-clockwise.
[[nodiscard]] std::vector<Point2> circle(const Point2& centre, double radius, int sides);

/// The closed prism over a convex polygon, counter-clockwise seen from above, from z = bottom to z = top.
[[nodiscard]] TriangleMesh prism(const std::vector<Point2>& polygon, double bottom, double top);

}  // namespace kreisel::core
