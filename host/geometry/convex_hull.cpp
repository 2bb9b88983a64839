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

struct Facet {
  Triangle corners;
  std::array<Index, 3> beside{nobody, nobody, nobody};
  /// Points that it sees, each kept by one facet: the first, and from there by the chain of all points.
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
    for (Index f = 0; f < facets_.size();) {
      if (facets_[f].last == gone || facets_[f].first == nobody) {
        ++f;
        continue;
      }
      stop_here();
      grow(f);
      if (gone_ > facets_.size() / 8) f = tidy(f);
    }
    next_ = std::vector<Index>();
    (void)tidy(0);
    return result();
  }

 private:
  [[nodiscard]] bool sees(const Facet& f, Index point) const {
    return orient3d(points_[f.corners[0]], points_[f.corners[1]], points_[f.corners[2]], points_[point]) > 0;
  }
  [[nodiscard]] double height(const Facet& f, Index point) const {
    const Vec3 &a = points_[f.corners[0]], &b = points_[f.corners[1]], &c = points_[f.corners[2]];
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
    facets_ = {{.corners = {a, b, c}, .beside = {1, 2, 3}},
               {.corners = {b, a, d}, .beside = {0, 3, 2}},
               {.corners = {c, b, d}, .beside = {0, 1, 3}},
               {.corners = {a, c, d}, .beside = {0, 2, 1}}};
    std::vector<Index> all(points_.size());
    std::iota(all.begin(), all.end(), Index{0});
    hand_out(all, 0);
  }

  /// Each point to the first facet from `from` on that sees it; who is seen by none lies inside.
  void hand_out(const std::vector<Index>& points, std::size_t from) {
    for (const Index p : points)
      for (std::size_t f = from; f < facets_.size(); ++f)
        if (sees(facets_[f], p)) {
          keep(facets_[f], p);
          break;
        }
  }

  void keep(Facet& facet, Index point) {
    (facet.first == nobody ? facet.first : next_[facet.last]) = point;
    facet.last = point;
    next_[point] = nobody;
  }

  void remove(Facet& facet) {
    facet.last = gone;
    ++gone_;
  }

  /// Leaves out the facets that are gone, or there would be several times as many as the hull has. The others
  /// stay in their order. @return  the new number of the first one that is left from `from` on
  Index tidy(Index from) {
    std::vector<Index> number(facets_.size());
    Index kept = 0, first = 0;
    for (Index f = 0; f < facets_.size(); ++f) {
      if (f == from) first = kept;
      number[f] = kept;
      if (facets_[f].last != gone) facets_[kept++] = facets_[f];
    }
    facets_.resize(kept);
    for (Facet& f : facets_)
      for (Index& b : f.beside) b = number[b];
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
    remove(facets_[facet]);
    while (!stack.empty()) {
      Step& step = stack.back();
      if (++step.done == 3) {
        for (Index p = facets_[step.facet].first; p != nobody; p = next_[p]) points.push_back(p);
        stack.pop_back();
        continue;
      }
      const int k = (step.entered + step.done) % 3;
      const Facet& here = facets_[step.facet];
      const Index next = here.beside[static_cast<std::size_t>(k)];
      if (facets_[next].last == gone) continue;
      if (!sees(facets_[next], point)) {
        rim.push_back({here.corners[static_cast<std::size_t>(k)],
                       here.corners[static_cast<std::size_t>((k + 1) % 3)], next});
        continue;
      }
      remove(facets_[next]);
      const Index from = step.facet;
      const auto at = std::ranges::find(facets_[next].beside, from) - facets_[next].beside.begin();
      stack.push_back({next, static_cast<int>(at), -1});
    }
  }

  void grow(Index facet) {
    Index point = facets_[facet].first;
    double most = height(facets_[facet], point);
    for (Index p = next_[point]; p != nobody; p = next_[p])
      if (const double h = height(facets_[facet], p); h > most) most = h, point = p;
    std::vector<Index> points;
    std::vector<HorizonEdge> rim;
    go(facet, point, points, rim);
    std::erase(points, point);
    const std::size_t first = facets_.size(), n = rim.size();
    for (std::size_t i = 0; i < n; ++i) {
      const HorizonEdge& e = rim[i];
      Facet& beyond = facets_[e.beyond];
      for (std::size_t k = 0; k < 3; ++k)
        if (beyond.corners[k] == e.b && beyond.corners[(k + 1) % 3] == e.a)
          beyond.beside[k] = static_cast<Index>(first + i);
      facets_.push_back({.corners = {e.a, e.b, point},
                         .beside = {e.beyond, static_cast<Index>(first + (i + 1) % n),
                                    static_cast<Index>(first + (i + n - 1) % n)}});
    }
    hand_out(points, first);
  }

  /// @pre  tidy
  [[nodiscard]] ConvexHull result() {
    ConvexHull hull;
    hull.facets.reserve(facets_.size());
    hull.beside.reserve(facets_.size());
    for (const Facet& f : facets_) {
      hull.facets.push_back(f.corners);
      hull.beside.push_back(f.beside);
    }
    facets_ = std::vector<Facet>();                     // {} would keep the room
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
  std::vector<Facet> facets_;
  std::size_t gone_ = 0;
};

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points) { return Quickhull(points).run(); }

}  // namespace kreisel::core
