// predicates.hpp - on which side? Signs of determinants that are right whatever the rounding.
#pragma once

#include "geometry/polygon.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

// The determinant is computed in double first; where its rounding bound leaves the sign open, it is summed
// again without any rounding, as an expansion of doubles. So every sign is that of the exact determinant of
// the given coordinates, as long as no product of three of them over- or underflows: coordinates other than
// zero must lie between 1e-90 and 1e100. [Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997]

/// Sign of (b - a) x (c - a): 1 when c lies left of the line from a to b, 0 on it, -1 right of it.
[[nodiscard]] int orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

/// Is p in the closed triangle a, b, c, which runs counter-clockwise?
[[nodiscard]] inline bool in_triangle(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
  return orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0;
}

/// Sign of ((b - a) x (c - a)) . (d - a): 1 when d is on the side from which a, b, c run counter-clockwise.
[[nodiscard]] int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The point without coordinate `axis`, the other two in cyclic order.
[[nodiscard]] inline Vec2 drop(const Vec3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// The axis along which the triangle may be dropped without becoming a segment, the best in double precision;
/// -1 when its corners lie on one line, exactly.
[[nodiscard]] int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace kreisel::core
