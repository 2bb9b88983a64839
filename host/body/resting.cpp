#include "body/resting.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/rotation.hpp"
#include "parallel.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

using Index = std::uint32_t;

const double joins_cosine = std::cos(ground_degrees * std::numbers::pi / 180);
const double bends_cosine = std::cos(10 * std::numbers::pi / 180);

/// They are asked for several times each; a hull that is kept has no room for them.
std::vector<Vec3> normals_of(const ConvexHull& hull) {
  std::vector<Vec3> normals(hull.facets.size());
  parallel_for(normals.size(), 1 << 14, [&](std::size_t f) { normals[f] = hull.normal(f); });
  return normals;
}

double area_of(const ConvexHull& hull, std::size_t f) {
  const Vec3 &a = hull.corner(f, 0), &b = hull.corner(f, 1), &c = hull.corner(f, 2);
  return (b - a).cross(c - a).norm() / 2;
}

/// Whether facet f lies in the plane of the ground, as far as one goes; `by` is beside it and does.
bool joins(const ConvexHull& hull, const Vec3& normal, std::size_t f, std::size_t by, const Ground& ground) {
  const Vec3& n = ground.down;
  if (normal.dot(n) < joins_cosine) return false;
  const Triangle& known = hull.facets[by];
  for (const std::uint32_t v : hull.facets[f])
    if (v != known[0] && v != known[1] && v != known[2])
      return n.dot(hull.corner(ground.facets[0], 0) - hull.vertices[v]) <= ground_play;
  return true;
}

std::vector<Index> largest_first(const ConvexHull& hull) {
  std::vector<double> areas(hull.facets.size());
  for (std::size_t f = 0; f < areas.size(); ++f) areas[f] = area_of(hull, f);
  std::vector<Index> order(areas.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, std::greater<>{}, [&](Index f) { return areas[f]; });
  return order;
}

/// Of the facets that reach each other from `from`, those that join its plane. Convex, so they hang together.
Ground ground_around(const ConvexHull& hull, const std::vector<Vec3>& normals, Index from,
                     std::vector<std::uint8_t>& seen) {
  Ground ground;
  ground.facets = {from};
  ground.down = normals[from];
  seen[from] = 1;
  double rim = 0, round = 0;
  for (std::size_t i = 0; i < ground.facets.size(); ++i) {
    const Index f = ground.facets[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index next = hull.beside[f][k];
      if (seen[next]) continue;
      if (joins(hull, normals[next], next, f, ground)) {
        seen[next] = 1;
        ground.facets.push_back(next);
        continue;
      }
      const double length = (hull.corner(f, (k + 1) % 3) - hull.corner(f, k)).norm();
      rim += length;
      if (normals[next].dot(ground.down) > bends_cosine) round += length;
    }
  }
  for (const Index f : ground.facets) seen[f] = 0;
  ground.rounded = round > 0.9 * rim;
  return ground;
}

/// The corners of a ground, seen from above, z along up.
SupportPolygon outline(const ConvexHull& hull, const Ground& ground, const Eigen::Matrix3d& turn) {
  std::vector<Index> corners;
  for (const Index f : ground.facets)
    corners.insert(corners.end(), hull.facets[f].begin(), hull.facets[f].end());
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<Vec2> points;
  for (const Index v : corners) points.emplace_back((turn * hull.vertices[v]).head<2>());
  return hull_of(std::move(points));
}

/// Across which edge of facet f a body falls whose centre of mass is over none of what carries it: the one
/// that it is farthest outside of. Nothing where it is over f.
std::optional<Index> rolls_to(const ConvexHull& hull, const Vec3& normal, Index f, const Vec3& centre) {
  double farthest = 0;
  std::optional<Index> next;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = hull.corner(f, k), &b = hull.corner(f, (k + 1) % 3);
    const Vec3 outward = (b - a).cross(normal).normalized();
    const double out = outward.dot(centre - a);
    if (out > farthest) farthest = out, next = hull.beside[f][k];
  }
  return next;
}

/// Where a body ends that begins to roll on each facet. Ways that meet go on together, so each is gone once:
/// on a fine round hull they are as long as its facets are many.
template <class Stable>
std::vector<Index> ends_of_rolling(const ConvexHull& hull, const std::vector<Vec3>& normals,
                                   const Vec3& centre, const Stable& stable) {
  constexpr Index unknown = ~Index{0}, under_way = unknown - 1;
  std::vector<Index> ends(hull.facets.size(), unknown), way;
  for (Index f = 0; f < ends.size(); ++f) {
    stop_here(f);
    Index at = f;
    way.clear();
    while (ends[at] == unknown) {
      way.push_back(at);
      ends[at] = under_way;
      if (stable(at)) break;
      const auto next = rolls_to(hull, normals[at], at, centre);
      // The centre of mass falls with every facet, so none comes twice; round-off may disagree.
      if (!next || ends[*next] == under_way) break;
      at = *next;
    }
    const Index end = ends[at] == under_way ? at : ends[at];
    for (const Index passed : way) ends[passed] = end;
  }
  return ends;
}

}  // namespace

const ConvexHull& LazyHull::of(const std::vector<Vec3>& vertices) const {
  std::call_once(made_->once, [&] { made_->hull = convex_hull(vertices); });
  return made_->hull;
}

double solid_angle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - p, v = b - p, w = c - p;
  const double l = u.norm(), m = v.norm(), n = w.norm();
  return 2 * std::atan2(u.dot(v.cross(w)), l * m * n + u.dot(v) * n + v.dot(w) * l + w.dot(u) * m);
}

std::optional<Ground> ground_of(const ConvexHull& hull, const Vec3& up) {
  const std::vector<Vec3> normals = normals_of(hull);
  std::vector<std::uint8_t> seen(hull.facets.size(), 0);
  std::optional<Ground> best;
  double largest = -1;
  for (Index f = 0; f < hull.facets.size(); ++f) {
    const double area = area_of(hull, f);
    if (normals[f].dot(-up) < joins_cosine || area <= largest) continue;
    largest = area;
    best = ground_around(hull, normals, f, seen);
  }
  return best;
}

Vec3 solid_angle_gradient(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto edge = [&](const Vec3& from, const Vec3& to) -> Vec3 {
    const Vec3 u = from - p, v = to - p;
    const double m = u.norm(), n = v.norm();
    return (m + n) / (m * n * (m * n + u.dot(v))) * u.cross(v);
  };
  return edge(a, b) + edge(b, c) + edge(c, a);
}

Grounds::Grounds(const ConvexHull& hull)
    : hull_(hull), normals_(normals_of(hull)), ground_of_(hull.facets.size(), ~Index{0}) {
  std::vector<std::uint8_t> seen(ground_of_.size(), 0);
  for (const Index f : largest_first(hull)) {
    if (ground_of_[f] != ~Index{0}) continue;
    stop_here();
    const Ground ground = ground_around(hull, normals_, f, seen);
    for (const Index g : ground.facets)
      if (ground_of_[g] == ~Index{0}) ground_of_[g] = static_cast<Index>(grounds_.size());
    const Vec3 up = -ground.down;
    const Eigen::Matrix3d turn = axis_to_z(up);
    grounds_.push_back({f, up, turn, outline(hull, ground, turn)});
  }
}

Resting Grounds::at(const Vec3& centre) const {
  Resting resting;
  for (const Carried& g : grounds_)
    resting.poses.push_back(
        {.facet = g.facet,
         .up = g.up,
         .area = g.outline.area,
         .inside = g.outline.corners.empty() ? 0 : g.outline.inside((g.turn * centre).head<2>())});
  resting.ends = ends_of_rolling(hull_, normals_, centre,
                                 [&](Index f) { return resting.poses[ground_of_[f]].stable(); });
  for (Index f = 0; f < resting.ends.size(); ++f) {
    resting.ends[f] = ground_of_[resting.ends[f]];
    resting.poses[resting.ends[f]].probability +=
        solid_angle(centre, hull_.corner(f, 0), hull_.corner(f, 1), hull_.corner(f, 2)) /
        (4 * std::numbers::pi);
  }
  return resting;
}

std::vector<RestingPose> resting_poses(const ConvexHull& hull, const Vec3& centre) {
  std::vector<RestingPose> poses = Grounds(hull).at(centre).poses;
  std::ranges::stable_sort(poses, [](const RestingPose& a, const RestingPose& b) {
    return a.probability != b.probability ? a.probability > b.probability : a.area > b.area;
  });
  return poses;
}

}  // namespace kreisel::core
