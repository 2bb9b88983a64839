#include "geometry/polygon.hpp"

#include <cmath>
#include <numbers>

#include "geometry/distance.hpp"
#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace {

/// Calls visit(corner, next corner) for every side.
template <class Visit>
void for_each_side(std::span<const Vec2> polygon, Visit&& visit) {
  for (std::size_t i = 0; i < polygon.size(); ++i) visit(polygon[i], polygon[(i + 1) % polygon.size()]);
}

}  // namespace

Polygon polygon_of(std::span<const Vec2> points, std::span<const std::uint32_t> loop) {
  Polygon polygon;
  for (const std::uint32_t i : loop) polygon.push_back(points[i]);
  return polygon;
}

// Both about the first corner, for round-off.

double area(std::span<const Vec2> polygon) {
  double twice = 0;
  for_each_side(polygon, [&](const Vec2& a, const Vec2& b) {
    twice += cross(a - polygon.front(), b - polygon.front());
  });
  return twice / 2;
}

Vec2 centroid(std::span<const Vec2> polygon) {
  const Vec2 first = polygon.front();
  Vec2 sum = Vec2::Zero();
  for_each_side(polygon, [&](const Vec2& a, const Vec2& b) {
    sum += cross(a - first, b - first) / 6 * (a - first + b - first);
  });
  return first + sum / area(polygon);
}

bool contains(std::span<const Vec2> polygon, const Vec2& p) {
  bool inside = false;
  for_each_side(polygon, [&](const Vec2& a, const Vec2& b) {
    if ((a[1] <= p[1]) == (b[1] <= p[1])) return;
    if ((orient2d(a, b, p) > 0) == (b[1] > a[1])) inside = !inside;
  });
  return inside;
}

Vec2 nearest_on_border(std::span<const Vec2> polygon, const Vec2& p) {
  Vec2 best = polygon.front();
  for_each_side(polygon, [&](const Vec2& a, const Vec2& b) {
    const Vec2 q = nearest_on_segment(p, a, b);
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  });
  return best;
}

Polygon circle(const Vec2& centre, double radius, int sides) {
  Polygon polygon;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    polygon.emplace_back(centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle));
  }
  return polygon;
}

}  // namespace kreisel::core
