#include "geometry/fill_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "error.hpp"
#include "geometry/clip_ears.hpp"
#include "geometry/flip_delaunay.hpp"
#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace {

using Points = std::span<const Vec2>;

/// What is on the right comes last, of equals what is above.
auto by_x(Points points) {
  return [points](std::uint32_t i) { return std::pair(points[i][0], points[i][1]); };
}

[[noreturn]] void refuse() {
  throw InputError("a section of the mesh crosses itself; expected a mesh that does not run through itself");
}

/// The place in the polygon from which `from`, a point of a hole to its left, can be seen: of the first edge
/// to the right its end further right, or what lies before that.
std::optional<std::size_t> visible_from(Points points, const Loop& polygon, const Vec2& from) {
  const std::size_t n = polygon.size();
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = points[polygon[i]], &b = points[polygon[(i + 1) % n]];
    // The inside lies to the left of an edge that goes up.
    if (!(a[1] <= from[1] && b[1] >= from[1] && a[1] != b[1]) || orient2d(a, b, from) < 0) continue;
    const double x = a[0] + (from[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    if (x >= nearest) continue;
    nearest = x;
    best = a[0] > b[0] ? i : (i + 1) % n;
  }
  if (!best) return std::nullopt;
  // Within the triangle of the hit, of reflex corners the one at the smallest angle to the ray, then the
  // nearest.
  const Vec2 hit = {nearest, from[1]}, corner = points[polygon[*best]];
  const bool above = corner[1] > from[1];
  const auto slope = [&](const Vec2& p) { return std::abs(p[1] - from[1]) / (p[0] - from[0]); };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& p = points[polygon[i]];
    if (!(p[0] > from[0]) || p == points[polygon[*best]]) continue;
    if (!(above ? in_triangle(p, from, hit, corner) : in_triangle(p, from, corner, hit))) continue;
    const Vec2& kept = points[polygon[*best]];
    if (slope(p) < slope(kept) || (slope(p) == slope(kept) && p[0] < kept[0])) best = i;
  }
  // A corner that a bridge has doubled: the copy whose wedge `from` lies in.
  for (std::size_t i = 0; i < n; ++i) {
    if (points[polygon[i]] != points[polygon[*best]]) continue;
    const Vec2 &p = points[polygon[i]], &before = points[polygon[(i + n - 1) % n]],
               &after = points[polygon[(i + 1) % n]];
    const bool left = orient2d(before, p, from) > 0, right = orient2d(p, after, from) > 0;
    if (orient2d(before, p, after) >= 0 ? left && right : left || right) return i;
  }
  return best;
}

/// Joins a hole to the polygon around it by an edge there and back.
void bridge(Points points, Loop& polygon, Loop hole) {
  const auto first = std::ranges::max_element(hole, {}, by_x(points));
  std::rotate(hole.begin(), first, hole.end());
  const auto at = visible_from(points, polygon, points[hole.front()]);
  if (!at) refuse();
  hole.push_back(hole.front());
  hole.push_back(polygon[*at]);
  polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(*at) + 1, hole.begin(), hole.end());
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> fill_polygon(Points points, std::vector<Loop> loops) {
  Loop polygon = std::move(loops.front());
  // From the right, so that what lies to the right of a hole is joined already.
  const auto rightmost = [&](const Loop& loop) {
    const auto x = by_x(points);
    return x(*std::ranges::max_element(loop, {}, x));
  };
  std::sort(loops.begin() + 1, loops.end(),
            [&](const Loop& a, const Loop& b) { return rightmost(a) > rightmost(b); });
  for (std::size_t i = 1; i < loops.size(); ++i) bridge(points, polygon, std::move(loops[i]));
  auto triangles = clip_ears(points, polygon);
  if (!triangles) refuse();
  flip_to_delaunay(points, *triangles);
  return *std::move(triangles);
}

std::vector<Loop> loops_along(std::map<std::uint32_t, std::uint32_t> next) {
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop& loop = loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      loop.push_back(at->first);
      const std::uint32_t onward = at->second;
      next.erase(at);
      at = next.find(onward);
    }
  }
  return loops;
}

std::vector<std::array<std::uint32_t, 3>> fill_loops(std::span<const Vec2> points,
                                                     const std::vector<Loop>& loops) {
  std::vector<std::vector<Loop>> regions;
  std::vector<double> areas;
  for (const Loop& loop : loops)
    if (const double enclosed = area(polygon_of(points, loop)); enclosed > 0) {
      regions.push_back({loop});
      areas.push_back(enclosed);
    }
  for (const Loop& loop : loops) {
    if (area(polygon_of(points, loop)) > 0) continue;
    std::size_t home = regions.size();
    for (std::size_t i = 0; i < regions.size(); ++i)
      if (contains(polygon_of(points, regions[i].front()), points[loop.front()]) &&
          (home == regions.size() || areas[i] < areas[home]))
        home = i;
    if (home == regions.size()) refuse();
    regions[home].push_back(loop);
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::vector<Loop>& region : regions) {
    const auto filled = fill_polygon(points, std::move(region));
    triangles.insert(triangles.end(), filled.begin(), filled.end());
  }
  return triangles;
}

}  // namespace kreisel::core
