#include "geometry/triangles_meet.hpp"

#include <algorithm>

#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace {

using Numbers = std::vector<std::uint32_t>;
using Numbering = std::function<std::uint32_t(ExactPoint)>;

/// Of a point in the triangle's plane.
bool holds(const CornersOf& t, const Vec3& p) {
  const int axis = projection_axis(t.at[0], t.at[1], t.at[2]);
  int left = 0, right = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = orient2d(drop(t.at[k], axis), drop(t.at[(k + 1) % 3], axis), drop(p, axis));
    left += side > 0;
    right += side < 0;
  }
  return !left || !right;
}

int side_of(const CornersOf& t, const Vec3& p) { return orient3d(t.at[0], t.at[1], t.at[2], p); }

/// Where the edge k of s passes through the plane of t from one side to the other, if within t.
void add_passage(const CornersOf& s, std::size_t k, const CornersOf& t, const Numbering& number,
                 Numbers& found) {
  const Vec3 &p = s.at[k], &q = s.at[(k + 1) % 3];
  std::array<int, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) side[i] = orient3d(p, q, t.at[i], t.at[(i + 1) % 3]);
  const auto [least, most] = std::ranges::minmax(side);
  if (least < 0 && most > 0) return;
  for (std::size_t i = 0; i < 3; ++i)
    if (side[i] == 0 && side[(i + 2) % 3] == 0) return found.push_back(t.number[i]);
  found.push_back(number(line_meets_plane(p, q, t.at)));
}

/// Points of edges of s in t, whose planes differ.
void add_edges(const CornersOf& s, const CornersOf& t, const Numbering& number, Numbers& found) {
  std::array<int, 3> side{};
  for (std::size_t k = 0; k < 3; ++k) side[k] = side_of(t, s.at[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (side[k] == 0 && holds(t, s.at[k])) found.push_back(s.number[k]);
    if (side[k] * side[(k + 1) % 3] < 0) add_passage(s, k, t, number, found);
  }
}

/// Appends the segments from each point to the next, all of one line.
void add_segments(Numbers points, const PointOf& point, std::vector<std::array<std::uint32_t, 2>>& segments) {
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.empty()) return;
  // By the coordinates in turn: along a line that is one way or the other.
  std::ranges::sort(points, [&](std::uint32_t a, std::uint32_t b) { return point(a) < point(b); });
  if (points.size() == 1) segments.push_back({points[0], points[0]});
  for (std::size_t i = 1; i < points.size(); ++i) segments.push_back({points[i - 1], points[i]});
}

/// The part of each edge of s that lies in t, which lies in the same plane.
void add_clipped_edges(const CornersOf& s, const CornersOf& t, const PointOf& point, const Numbering& number,
                       std::vector<std::array<std::uint32_t, 2>>& segments) {
  const int axis = projection_axis(t.at[0], t.at[1], t.at[2]);
  const auto flat = [&](const Vec3& p) { return drop(p, axis); };
  const auto on = [&](const Vec3& p, const Vec3& q, const Vec3& x) {
    return orient2d(flat(p), flat(q), flat(x)) == 0 && (p.cwiseMin(q).array() <= x.array()).all() &&
           (x.array() <= p.cwiseMax(q).array()).all();
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const Vec3 &p = s.at[k], &q = s.at[next];
    Numbers found;
    for (const std::size_t end : {k, next})
      if (holds(t, s.at[end])) found.push_back(s.number[end]);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const Vec3 &a = t.at[i], &b = t.at[j];
      if (on(p, q, a)) found.push_back(t.number[i]);
      if (orient2d(flat(a), flat(b), flat(p)) * orient2d(flat(a), flat(b), flat(q)) < 0 &&
          orient2d(flat(p), flat(q), flat(a)) * orient2d(flat(p), flat(q), flat(b)) < 0)
        found.push_back(number(lines_meet(point(s.number[k]), point(s.number[next]), point(t.number[i]),
                                          point(t.number[j]), axis)));
    }
    add_segments(std::move(found), point, segments);
  }
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> triangles_meet(const CornersOf& s, const CornersOf& t,
                                                         const PointOf& point, const Numbering& number) {
  std::vector<std::array<std::uint32_t, 2>> segments;
  if (side_of(t, s.at[0]) == 0 && side_of(t, s.at[1]) == 0 && side_of(t, s.at[2]) == 0) {
    add_clipped_edges(s, t, point, number, segments);
    add_clipped_edges(t, s, point, number, segments);
    return segments;
  }
  Numbers found;
  add_edges(s, t, number, found);
  add_edges(t, s, number, found);
  add_segments(std::move(found), point, segments);
  return segments;
}

}  // namespace kreisel::core
