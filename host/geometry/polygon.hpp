// polygon.hpp - plane vectors and polygons.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace kreisel::core {

using Vec2 = Eigen::Vector2d;

/// a x b: twice the area of the triangle 0, a, b; positive when b lies left of a.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The corners of a ring, each once.
using Polygon = std::vector<Vec2>;

/// Points of a closed line, one after the other.
using Loop = std::vector<std::uint32_t>;
[[nodiscard]] Polygon polygon_of(std::span<const Vec2> points, std::span<const std::uint32_t> loop);

/// Positive when the polygon runs counter-clockwise.
[[nodiscard]] double area(std::span<const Vec2> polygon);
/// Of the area, which is not zero.
[[nodiscard]] Vec2 centroid(std::span<const Vec2> polygon);
/// Even-odd rule with exact signs; on the border: either.
[[nodiscard]] bool contains(std::span<const Vec2> polygon, const Vec2& p);
/// The point of the border nearest to p. The polygon has corners.
[[nodiscard]] Vec2 nearest_on_border(std::span<const Vec2> polygon, const Vec2& p);

/// A regular polygon with its corners on the circle, counter-clockwise from the x-axis.
[[nodiscard]] Polygon circle(const Vec2& centre, double radius, int sides);

}  // namespace kreisel::core
