// support_polygon.hpp - what a body stands on.
#pragma once

#include <vector>

#include "geometry/polygon.hpp"

namespace kreisel::core {

struct Body;

/// Convex hull, counter-clockwise seen from above, of the vertices near the ground. Body frame and units.
struct SupportPolygon {
  /// n . p <= d inside; n is the unit outward normal of the edge.
  struct Edge {
    Vec2 n;
    double d;
  };

  Polygon corners;          ///< at least three, no three on a line
  std::vector<Edge> edges;  ///< edge i runs from corner i to corner i + 1
  double area = 0;
  Vec2 centroid = Vec2::Zero();  ///< of the area

  /// Distance of p from the nearest edge's line; negative outside.
  [[nodiscard]] double inside(const Vec2& p) const;
  /// The point of the polygon that is nearest to p: p itself where it is not outside.
  [[nodiscard]] Vec2 nearest(const Vec2& p) const;
};

/// What of the polygon is at least `margin` inside every edge's line; no corners where that has no area.
/// @param margin  >= 0
[[nodiscard]] SupportPolygon shrunk(const SupportPolygon& polygon, double margin);

/// @param tolerance  share of the body's height: vertices that near to the lowest touch the ground
/// @throws InputError  fewer than three such vertices, or all on a line: the body stands on a point or an
/// edge
[[nodiscard]] SupportPolygon support_polygon(const Body& body, double tolerance = 1e-3);

/// What a body rests on in its pose: the facets of its hull that carry it (resting.hpp), seen from above.
/// @return  no corners where it has no base: it stands on a corner, an edge, less than a hundredth of a body
///          length across, or on a rounded place that is less than a tenth across
[[nodiscard]] SupportPolygon resting_polygon(const Body& body);

/// The hull of any points; no corners when they have no area.
[[nodiscard]] SupportPolygon hull_of(std::vector<Vec2> points);

}  // namespace kreisel::core
