#include "body/support_polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "body/body.hpp"
#include "error.hpp"

namespace kreisel::core {
namespace {

/// One chain of the hull, points sorted; keeps left turns only. [Andrew 1979, monotone chain]
Polygon chain(const std::vector<Vec2>& sorted) {
  Polygon out;
  for (const Vec2& p : sorted) {
    while (out.size() >= 2 && cross(out.back() - out[out.size() - 2], p - out.back()) <= 0) out.pop_back();
    out.push_back(p);
  }
  return out;
}

/// Drops the corners of a convex polygon that span next to nothing with their neighbours. Not part of
/// chain(): there the next point may lie behind, and a true corner with it.
void drop_flat(Polygon& corners, double negligible) {
  for (std::size_t i = 0; corners.size() >= 3 && i < corners.size();) {
    const Vec2& before = corners[(i + corners.size() - 1) % corners.size()];
    const Vec2& after = corners[(i + 1) % corners.size()];
    if (cross(corners[i] - before, after - corners[i]) <= negligible)
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
}

/// What of a convex ring of corners lies on the inner side of a line. [Sutherland, Hodgman 1974]
Polygon clipped(const Polygon& corners, const SupportPolygon::Edge& line) {
  Polygon kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double at_a = line.d - line.n.dot(a), at_b = line.d - line.n.dot(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return kept;
}

}  // namespace

double SupportPolygon::inside(const Vec2& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Edge& e : edges) least = std::min(least, e.d - e.n.dot(p));
  return least;
}

Vec2 SupportPolygon::nearest(const Vec2& p) const {
  return inside(p) >= 0 ? p : nearest_on_border(corners, p);
}

SupportPolygon shrunk(const SupportPolygon& polygon, double margin) {
  if (margin == 0) return polygon;
  Polygon corners = polygon.corners;
  for (const SupportPolygon::Edge& e : polygon.edges) corners = clipped(corners, {e.n, e.d - margin});
  return hull_of(std::move(corners));
}

SupportPolygon hull_of(std::vector<Vec2> points) {
  SupportPolygon polygon;
  if (points.size() < 3) return polygon;
  std::ranges::sort(
      points, [](const Vec2& a, const Vec2& b) { return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]); });
  const double size = (points.back() - points.front()).norm();
  Polygon corners = chain(points);
  std::ranges::reverse(points);
  const Polygon upper = chain(points);
  corners.pop_back();
  corners.insert(corners.end(), upper.begin(), upper.end() - 1);
  // Corners that stick out by round-off of a flat base's coordinates are none.
  drop_flat(corners, 1e-12 * size * size);
  if (corners.size() < 3) return polygon;

  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const Vec2 along = (b - a).normalized(), n(along[1], -along[0]);
    polygon.edges.push_back({n, n.dot(a)});
  }
  polygon.area = area(corners);
  polygon.centroid = centroid(corners);
  polygon.corners = std::move(corners);
  return polygon;
}

SupportPolygon support_polygon(const Body& body, double tolerance) {
  const Box box = bounding_box(body.local);
  const double ground = box.lo[2] + tolerance * box.extent()[2];
  std::vector<Vec2> touching;
  for (const Vec3& v : body.local.vertices)
    if (v[2] <= ground) touching.emplace_back(v.head<2>());
  const std::size_t count = touching.size();
  SupportPolygon polygon = hull_of(std::move(touching));
  // A hundredth of a body length across is the least that anything can be stood on.
  if (polygon.corners.empty() || polygon.area < 1e-4)
    throw InputError(fmt::format(
        "{} has no base to stand on: {} of its vertices lie within {:.3g} % of its height above the ground "
        "and span {:.2g} mm^2; expected three or more corners that span an area (try another --up, or a "
        "larger --set problem.base=SHARE%)",
        body.name, count, 100 * tolerance, polygon.area * body.frame.length * body.frame.length));
  return polygon;
}

SupportPolygon resting_polygon(const Body& body) {
  const ConvexHull& hull = body.hull.of(body.mesh.vertices);
  const auto ground = ground_of(hull, body.frame.rotation.row(2));
  if (!ground) return {};
  std::vector<Vec2> corners;
  for (const std::uint32_t f : ground->facets)
    for (std::size_t k = 0; k < 3; ++k) corners.emplace_back(body.frame.to_body(hull.corner(f, k)).head<2>());
  SupportPolygon polygon = hull_of(std::move(corners));
  constexpr double least_area = 1e-4, least_round = 0.05;  // body lengths
  if (polygon.corners.empty() || polygon.area < least_area) return {};
  if (ground->rounded && polygon.inside(polygon.centroid) < least_round) return {};
  return polygon;
}

}  // namespace kreisel::core
