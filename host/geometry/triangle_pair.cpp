#include "geometry/triangle_pair.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace {

using Corners = std::array<Vec3, 3>;

bool between(const Vec2& p, const Vec2& q, const Vec2& x) {
  return (p.cwiseMin(q).array() <= x.array()).all() && (x.array() <= p.cwiseMax(q).array()).all();
}

/// Closed segments in the plane.
bool segments_meet(const Vec2& p, const Vec2& q, const Vec2& a, const Vec2& b) {
  const int pa = orient2d(a, b, p), qa = orient2d(a, b, q), ap = orient2d(p, q, a), bp = orient2d(p, q, b);
  if (pa * qa < 0 && ap * bp < 0) return true;
  return (pa == 0 && between(a, b, p)) || (qa == 0 && between(a, b, q)) || (ap == 0 && between(p, q, a)) ||
         (bp == 0 && between(p, q, b));
}

/// A closed segment in the plane of a closed triangle.
bool meet_in_plane(const Vec3& p, const Vec3& q, const Corners& t) {
  const int axis = projection_axis(t[0], t[1], t[2]);
  const Vec2 p2 = drop(p, axis), q2 = drop(q, axis);
  const std::array<Vec2, 3> c{drop(t[0], axis), drop(t[1], axis), drop(t[2], axis)};
  int left = 0, right = 0;  // p against the three edges
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = orient2d(c[k], c[(k + 1) % 3], p2);
    left += side >= 0;
    right += side <= 0;
  }
  if (left == 3 || right == 3) return true;
  for (std::size_t k = 0; k < 3; ++k)
    if (segments_meet(p2, q2, c[k], c[(k + 1) % 3])) return true;
  return false;
}

/// A closed segment and a closed triangle. @param sp, sq  sides of its ends against the triangle's plane
bool segment_meets(const Vec3& p, const Vec3& q, const Corners& t, int sp, int sq) {
  if (sp * sq > 0) return false;
  if (sp == 0 && sq == 0) return meet_in_plane(p, q, t);
  // The line crosses the plane in one point, which lies inside when the line passes all edges on one side.
  int left = 0, right = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = orient3d(p, q, t[k], t[(k + 1) % 3]);
    if (side > 0) ++left;
    if (side < 0) ++right;
    if (left && right) return false;
  }
  return true;
}

std::array<int, 3> sides(const Corners& t, const Corners& of) {
  return {orient3d(t[0], t[1], t[2], of[0]), orient3d(t[0], t[1], t[2], of[1]),
          orient3d(t[0], t[1], t[2], of[2])};
}

bool all_on_one_side(const std::array<int, 3>& s) {
  return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}

/// Does a side of s, seen along `axis`, have s on one hand and all of t on the other, shared corners (the
/// first ones of both) aside? Then the two have nothing else in common. Cheap, and spares flat neighbours the
/// exact sums.
bool side_separates(const Corners& s, const Corners& t, std::size_t shared, int axis) {
  const std::array<Vec2, 3> a{drop(s[0], axis), drop(s[1], axis), drop(s[2], axis)};
  const std::array<Vec2, 3> b{drop(t[0], axis), drop(t[1], axis), drop(t[2], axis)};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (shared && k != 0 && next != 0) continue;  // the line must pass through the shared corner
    const int own = orient2d(a[k], a[next], a[(k + 2) % 3]);
    bool apart = own != 0;
    for (std::size_t i = shared; apart && i < 3; ++i) apart = own * orient2d(a[k], a[next], b[i]) < 0;
    if (apart) return true;
  }
  return false;
}

bool separated(const Corners& s, const Corners& t, std::size_t shared) {
  int axis = 0;
  (s[1] - s[0]).cross(s[2] - s[0]).cwiseAbs().maxCoeff(&axis);
  return side_separates(s, t, shared, axis) || side_separates(t, s, shared, axis);
}

bool disjoint_corners(const Corners& s, const Corners& t) {
  if (separated(s, t, 0)) return false;
  const auto s_against_t = sides(t, s);
  if (all_on_one_side(s_against_t)) return false;
  const auto t_against_s = sides(s, t);
  if (all_on_one_side(t_against_s)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (segment_meets(s[k], s[next], t, s_against_t[k], s_against_t[next])) return true;
    if (segment_meets(t[k], t[next], s, t_against_s[k], t_against_s[next])) return true;
  }
  return false;
}

/// Corner 0 is shared. What else the two have in common would reach the far edge of one of them.
bool one_shared_corner(const Corners& s, const Corners& t) {
  if (separated(s, t, 1)) return false;
  const int s1 = orient3d(t[0], t[1], t[2], s[1]), s2 = orient3d(t[0], t[1], t[2], s[2]);
  if (segment_meets(s[1], s[2], t, s1, s2)) return true;
  const int t1 = orient3d(s[0], s[1], s[2], t[1]), t2 = orient3d(s[0], s[1], s[2], t[2]);
  return segment_meets(t[1], t[2], s, t1, t2);
}

/// Corners 0 and 1 are shared: improper only when the third corners lie in one plane with them, on one side.
bool shared_edge(const Corners& s, const Corners& t) {
  const int axis = projection_axis(s[0], s[1], s[2]);
  const Vec2 a = drop(s[0], axis), b = drop(s[1], axis);
  if (orient2d(a, b, drop(s[2], axis)) != orient2d(a, b, drop(t[2], axis))) return false;  // most pairs
  return orient3d(s[0], s[1], s[2], t[2]) == 0;
}

}  // namespace

bool intersect_improperly(const NumberedTriangle& s, const NumberedTriangle& t) {
  Corners a = s.corner, b = t.corner;
  Triangle b_number = t.number;
  std::size_t shared = 0;  // shared corners move to the front of both
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(b_number.begin() + shared, b_number.end(), s.number[i]);
    if (found == b_number.end()) continue;
    const auto j = std::size_t(found - b_number.begin());
    std::swap(a[shared], a[i]);
    std::swap(b[shared], b[j]);
    std::swap(b_number[shared], b_number[j]);
    ++shared;
  }
  switch (shared) {
    case 0:
      return disjoint_corners(a, b);
    case 1:
      return one_shared_corner(a, b);
    case 2:
      return shared_edge(a, b);
    default:
      return true;
  }
}

}  // namespace kreisel::core
