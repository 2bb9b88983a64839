#include "body/resting.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "geometry/rotation.hpp"
#include "parallel.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

using Index = std::uint32_t;

const double joins_cosine = std::cos(ground_degrees * std::numbers::pi / 180);
const double bends_cosine = std::cos(10 * std::numbers::pi / 180);

/// Normals that are asked for several times each. A large hull fills the memory: they are kept in single
/// precision, which decides all but the nearest cases.
class Normals {
 public:
  explicit Normals(const ConvexHull& hull) : hull_(hull), kept_(hull.facets.size()) {
    parallel_for(kept_.size(), 1 << 14, [&](std::size_t f) { kept_[f] = hull_.normal(f).cast<float>(); });
  }

  [[nodiscard]] Vec3 operator[](std::size_t f) const { return hull_.normal(f); }
  /// Is it turned from a direction by no more than an angle of that cosine?
  [[nodiscard]] bool within(std::size_t f, const Vec3& direction, double cosine) const {
    const double rounded = kept_[f].cast<double>().dot(direction);
    constexpr double unsure = 4 * std::numeric_limits<float>::epsilon();  // three roundings, each of half
    return std::abs(rounded - cosine) > unsure ? rounded > cosine : hull_.normal(f).dot(direction) >= cosine;
  }

 private:
  const ConvexHull& hull_;
  std::vector<Eigen::Vector3f> kept_;
};

/// Normals of which few are asked for.
struct NormalsAsAsked {
  const ConvexHull& hull;

  [[nodiscard]] Vec3 operator[](std::size_t f) const { return hull.normal(f); }
  [[nodiscard]] bool within(std::size_t f, const Vec3& direction, double cosine) const {
    return hull.normal(f).dot(direction) >= cosine;
  }
};

double area_of(const ConvexHull& hull, std::size_t f) {
  const Vec3 &a = hull.corner(f, 0), &b = hull.corner(f, 1), &c = hull.corner(f, 2);
  return (b - a).cross(c - a).norm() / 2;
}

/// Whether facet f lies in the plane of the ground, as far as one goes; `by` is beside it and does.
template <class Normals>
bool joins(const ConvexHull& hull, const Normals& normals, std::size_t f, std::size_t by,
           const Ground& ground) {
  const Vec3& n = ground.down;
  if (!normals.within(f, n, joins_cosine)) return false;
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
template <class Normals>
Ground ground_around(const ConvexHull& hull, const Normals& normals, Index from,
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
      if (joins(hull, normals, next, f, ground)) {
        seen[next] = 1;
        ground.facets.push_back(next);
        continue;
      }
      const double length = (hull.corner(f, (k + 1) % 3) - hull.corner(f, k)).norm();
      rim += length;
      if (normals.within(next, ground.down, bends_cosine)) round += length;
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
std::vector<Index> ends_of_rolling(const ConvexHull& hull, const Vec3& centre, const Stable& stable) {
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
      const auto next = rolls_to(hull, hull.normal(at), at, centre);
      // The centre of mass falls with every facet, so none comes twice; round-off may disagree.
      if (!next || ends[*next] == under_way) break;
      at = *next;
    }
    const Index end = ends[at] == under_way ? at : ends[at];
    for (const Index passed : way) ends[passed] = end;
  }
  return ends;
}

/// All grounds, the largest facet's first: visit(facet, up, turn of up to z, outline). @return  by facet the
/// number of the first ground that it is of
template <class Visit>
std::vector<Index> visit_grounds(const ConvexHull& hull, const Visit& visit) {
  constexpr Index none = ~Index{0};
  const std::vector<Index> order = largest_first(hull);  // ahead of what else fills the memory
  const Normals normals(hull);
  std::vector<Index> ground_of(hull.facets.size(), none);
  std::vector<std::uint8_t> seen(ground_of.size(), 0);
  Index count = 0;
  for (const Index f : order) {
    if (ground_of[f] != none) continue;
    stop_here();
    const Ground ground = ground_around(hull, normals, f, seen);
    for (const Index g : ground.facets)
      if (ground_of[g] == none) ground_of[g] = count;
    ++count;
    const Vec3 up = -ground.down;
    const Eigen::Matrix3d turn = axis_to_z(up);
    visit(f, up, turn, outline(hull, ground, turn));
  }
  return ground_of;
}

RestingPose pose_on(Index facet, const Vec3& up, const Eigen::Matrix3d& turn, const SupportPolygon& carried,
                    const Vec3& centre) {
  return {.facet = facet,
          .up = up,
          .area = carried.area,
          .inside = carried.corners.empty() ? 0 : carried.inside((turn * centre).head<2>())};
}

/// Adds the probabilities of poses that have none yet.
Resting at_rest(const ConvexHull& hull, const std::vector<Index>& ground_of, const Vec3& centre,
                std::vector<RestingPose> poses) {
  Resting resting{std::move(poses), {}};
  resting.ends = ends_of_rolling(hull, centre, [&](Index f) { return resting.poses[ground_of[f]].stable(); });
  for (Index f = 0; f < resting.ends.size(); ++f) {
    resting.ends[f] = ground_of[resting.ends[f]];
    resting.poses[resting.ends[f]].probability +=
        solid_angle(centre, hull.corner(f, 0), hull.corner(f, 1), hull.corner(f, 2)) / (4 * std::numbers::pi);
  }
  return resting;
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
  const NormalsAsAsked normals{hull};
  std::vector<std::uint8_t> seen(hull.facets.size(), 0);
  std::optional<Ground> best;
  double largest = -1;
  for (Index f = 0; f < hull.facets.size(); ++f) {
    const double area = area_of(hull, f);
    if (area <= largest || !normals.within(f, -up, joins_cosine)) continue;
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

Grounds::Grounds(const ConvexHull& hull) : hull_(hull) {
  ground_of_ = visit_grounds(
      hull, [&](Index facet, const Vec3& up, const Eigen::Matrix3d& turn, SupportPolygon outline) {
        grounds_.push_back({facet, up, turn, std::move(outline)});
      });
}

Resting Grounds::at(const Vec3& centre) const {
  std::vector<RestingPose> poses;
  for (const Carried& g : grounds_) poses.push_back(pose_on(g.facet, g.up, g.turn, g.outline, centre));
  return at_rest(hull_, ground_of_, centre, std::move(poses));
}

std::vector<RestingPose> resting_poses(const ConvexHull& hull, const Vec3& centre) {
  // As Grounds, but outlines are not kept: a round hull has many.
  std::vector<RestingPose> poses;
  const std::vector<Index> ground_of = visit_grounds(
      hull, [&](Index facet, const Vec3& up, const Eigen::Matrix3d& turn, const SupportPolygon& outline) {
        poses.push_back(pose_on(facet, up, turn, outline, centre));
      });
  poses = at_rest(hull, ground_of, centre, std::move(poses)).poses;
  std::ranges::stable_sort(poses, [](const RestingPose& a, const RestingPose& b) {
    return a.probability != b.probability ? a.probability > b.probability : a.area > b.area;
  });
  return poses;
}

}  // namespace kreisel::core
