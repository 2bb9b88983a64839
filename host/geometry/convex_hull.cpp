#include "geometry/convex_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/predicates.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

using Index = std::uint32_t;
constexpr Index nobody = ~Index{0}, gone = nobody - 1;

/// Points that a facet sees, each kept by one facet: the first, and from there by the chain of all points.
struct Seen {
  Index first = nobody;
  Index last = nobody;  ///< `gone` of what is no facet any more
};

class Quickhull {
 public:
  explicit Quickhull(std::span<const Vec3> points) : points_(points), next_(points.size()) {}

  [[nodiscard]] ConvexHull run() {
    const auto first = first_tetrahedron();
    if (!first) return {};
    begin(*first);
    for (Index f = 0; f < seen_.size();) {
      if (seen_[f].last == gone || seen_[f].first == nobody) {
        ++f;
        continue;
      }
      stop_here();
      grow(f);
      if (gone_ > seen_.size() / 8) f = tidy(f);
    }
    next_ = std::vector<Index>();  // {} would keep the room
    (void)tidy(0);
    seen_ = std::vector<Seen>();
    return result();
  }

 private:
  [[nodiscard]] bool sees(std::size_t facet, Index point) const {
    const Triangle& t = corners_[facet];
    return orient3d(points_[t[0]], points_[t[1]], points_[t[2]], points_[point]) > 0;
  }
  [[nodiscard]] double height(Index facet, Index point) const {
    const Triangle& t = corners_[facet];
    const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    return (b - a).cross(c - a).dot(points_[point] - a);
  }

  template <class Measure>
  [[nodiscard]] Index farthest(const Measure& measure) const {
    Index best = 0;
    double most = -1;
    for (Index i = 0; i < points_.size(); ++i)
      if (const double value = measure(points_[i]); value > most) most = value, best = i;
    return best;
  }

  /// Counter-clockwise seen from outside is to be positive, so that the last sees none of the first three.
  [[nodiscard]] std::optional<std::array<Index, 4>> first_tetrahedron() const {
    if (points_.size() < 4) return std::nullopt;
    const Vec3 start = points_[0];
    const Index a = farthest([&](const Vec3& p) { return (p - start).squaredNorm(); });
    const Index b = farthest([&](const Vec3& p) { return (p - points_[a]).squaredNorm(); });
    const Vec3 along = points_[b] - points_[a];
    const Index c = farthest([&](const Vec3& p) { return along.cross(p - points_[a]).squaredNorm(); });
    const Vec3 normal = along.cross(points_[c] - points_[a]);
    const Index d = farthest([&](const Vec3& p) { return std::abs(normal.dot(p - points_[a])); });
    const int side = orient3d(points_[a], points_[b], points_[c], points_[d]);
    if (side == 0) return std::nullopt;
    return side < 0 ? std::array{a, b, c, d} : std::array{a, c, b, d};
  }

  void begin(const std::array<Index, 4>& t) {
    const auto [a, b, c, d] = t;
    add({a, b, c}, {1, 2, 3});
    add({b, a, d}, {0, 3, 2});
    add({c, b, d}, {0, 1, 3});
    add({a, c, d}, {0, 2, 1});
    std::vector<Index> all(points_.size());
    std::iota(all.begin(), all.end(), Index{0});
    hand_out(all, 0);
  }

  void add(const Triangle& corners, const std::array<Index, 3>& beside) {
    corners_.push_back(corners);
    beside_.push_back(beside);
    seen_.emplace_back();
  }

  /// Each point to the first facet from `from` on that sees it; who is seen by none lies inside.
  void hand_out(const std::vector<Index>& points, std::size_t from) {
    for (const Index p : points)
      for (std::size_t f = from; f < corners_.size(); ++f)
        if (sees(f, p)) {
          keep(seen_[f], p);
          break;
        }
  }

  void keep(Seen& seen, Index point) {
    (seen.first == nobody ? seen.first : next_[seen.last]) = point;
    seen.last = point;
    next_[point] = nobody;
  }

  void remove(Index facet) {
    seen_[facet].last = gone;
    ++gone_;
  }

  /// Leaves out the facets that are gone, or there would be several times as many as the hull has. The others
  /// stay in their order. @return  the new number of the first one that is left from `from` on
  Index tidy(Index from) {
    std::vector<Index> number(seen_.size());
    Index kept = 0, first = 0;
    for (Index f = 0; f < seen_.size(); ++f) {
      if (f == from) first = kept;
      number[f] = kept;
      if (seen_[f].last == gone) continue;
      corners_[kept] = corners_[f];
      beside_[kept] = beside_[f];
      seen_[kept++] = seen_[f];
    }
    corners_.resize(kept);
    beside_.resize(kept);
    seen_.resize(kept);
    for (std::array<Index, 3>& beside : beside_)
      for (Index& b : beside) b = number[b];
    gone_ = 0;
    return first;
  }

  struct HorizonEdge {
    Index a, b, beyond;  ///< from a to b as the facet that goes has it
  };

  /// The facets that the point sees go; their rim, in order.
  void go(Index facet, Index point, std::vector<Index>& points, std::vector<HorizonEdge>& rim) {
    // Depth first around each facet from the edge by which it was entered, so that the rim comes in order.
    struct Step {
      Index facet;
      int entered, done;
    };
    std::vector<Step> stack = {{facet, 0, -1}};
    remove(facet);
    while (!stack.empty()) {
      Step& step = stack.back();
      if (++step.done == 3) {
        for (Index p = seen_[step.facet].first; p != nobody; p = next_[p]) points.push_back(p);
        stack.pop_back();
        continue;
      }
      const int k = (step.entered + step.done) % 3;
      const Index next = beside_[step.facet][static_cast<std::size_t>(k)];
      if (seen_[next].last == gone) continue;
      if (!sees(next, point)) {
        const Triangle& here = corners_[step.facet];
        rim.push_back({here[static_cast<std::size_t>(k)], here[static_cast<std::size_t>((k + 1) % 3)], next});
        continue;
      }
      remove(next);
      const Index from = step.facet;
      const auto at = std::ranges::find(beside_[next], from) - beside_[next].begin();
      stack.push_back({next, static_cast<int>(at), -1});
    }
  }

  void grow(Index facet) {
    Index point = seen_[facet].first;
    double most = height(facet, point);
    for (Index p = next_[point]; p != nobody; p = next_[p])
      if (const double h = height(facet, p); h > most) most = h, point = p;
    std::vector<Index> points;
    std::vector<HorizonEdge> rim;
    go(facet, point, points, rim);
    std::erase(points, point);
    const std::size_t first = corners_.size(), n = rim.size();
    for (std::size_t i = 0; i < n; ++i) {
      const HorizonEdge& e = rim[i];
      const Triangle& beyond = corners_[e.beyond];
      for (std::size_t k = 0; k < 3; ++k)
        if (beyond[k] == e.b && beyond[(k + 1) % 3] == e.a)
          beside_[e.beyond][k] = static_cast<Index>(first + i);
      add({e.a, e.b, point},
          {e.beyond, static_cast<Index>(first + (i + 1) % n), static_cast<Index>(first + (i + n - 1) % n)});
    }
    hand_out(points, first);
  }

  /// @pre  tidy
  [[nodiscard]] ConvexHull result() {
    ConvexHull hull;
    hull.facets = std::move(corners_);
    hull.beside = std::move(beside_);
    hull.facets.shrink_to_fit();
    hull.beside.shrink_to_fit();
    hull.vertices.reserve(hull.facets.size() / 2 + 2);  // Euler's formula
    std::vector<Index> vertex_number(points_.size(), nobody);
    for (Triangle& t : hull.facets)
      for (Index& v : t) {
        Index& number = vertex_number[v];
        if (number == nobody) {
          number = static_cast<Index>(hull.vertices.size());
          hull.vertices.push_back(points_[v]);
        }
        v = number;
      }
    return hull;
  }

  std::span<const Vec3> points_;
  std::vector<Index> next_;  ///< of each point that a facet keeps
  /// Of each facet: apart, for a large hull fills the memory, and takes two of them as they are.
  std::vector<Triangle> corners_;
  std::vector<std::array<Index, 3>> beside_;
  std::vector<Seen> seen_;
  std::size_t gone_ = 0;
};

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points) { return Quickhull(points).run(); }

}  // namespace kreisel::core
