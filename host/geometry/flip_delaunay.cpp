#include "geometry/flip_delaunay.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

class Flips {
 public:
  Flips(std::span<const Vec2> points, Triangles& triangles) : points_(points), triangles_(triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
        sides_[key(a, b)] = t;
        if (a < b)
          open_.push_back({a, b});
        else if (!sides_.contains(key(b, a)))
          open_.push_back({b, a});
      }
  }

  void run() {
    // Each turn raises the smallest of the angles around; rounding could make a circle of it, so there is an
    // end.
    for (std::size_t left = 64 * triangles_.size() + 64; !open_.empty() && left > 0; --left) {
      const auto [a, b] = open_.back();
      open_.pop_back();
      flip(a, b);
    }
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t(a) << 32 | b; }

  /// Of the triangle to the left of an edge.
  [[nodiscard]] std::uint32_t opposite(std::size_t t, std::uint32_t a, std::uint32_t b) const {
    const auto& corners = triangles_[t];
    return *std::ranges::find_if(corners, [&](std::uint32_t c) { return c != a && c != b; });
  }

  /// The sine of the sum of the angles at c and d, opposite of the edge ab, is below 0 beyond the circle;
  /// times the lengths of the four sides.
  [[nodiscard]] bool within_circle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    const Vec2 ca = points_[a] - points_[c], cb = points_[b] - points_[c], da = points_[a] - points_[d],
               db = points_[b] - points_[d];
    const double sines = cross(ca, cb) * da.dot(db) + ca.dot(cb) * cross(db, da);
    return sines < -1e-12 * std::sqrt(ca.dot(ca) * cb.dot(cb) * da.dot(da) * db.dot(db));
  }

  void flip(std::uint32_t a, std::uint32_t b) {
    const auto left = sides_.find(key(a, b)), right = sides_.find(key(b, a));
    if (left == sides_.end() || right == sides_.end()) return;
    const std::size_t t = left->second, u = right->second;
    const std::uint32_t c = opposite(t, a, b), d = opposite(u, a, b);
    if (c == d || !within_circle(a, b, c, d)) return;
    // Only where both new triangles have an area.
    if (orient2d(points_[c], points_[d], points_[b]) <= 0 ||
        orient2d(points_[d], points_[c], points_[a]) <= 0)
      return;
    if (sides_.contains(key(c, d)) || sides_.contains(key(d, c))) return;
    sides_.erase(left);
    sides_.erase(key(b, a));
    put(t, {c, d, b});
    put(u, {d, c, a});
    for (const auto& [p, q] : {std::pair{a, c}, {c, b}, {b, d}, {d, a}}) open_.push_back({p, q});
  }

  void put(std::size_t t, const std::array<std::uint32_t, 3>& corners) {
    triangles_[t] = corners;
    for (std::size_t k = 0; k < 3; ++k) sides_[key(corners[k], corners[(k + 1) % 3])] = t;
  }

  std::span<const Vec2> points_;
  Triangles& triangles_;
  std::unordered_map<std::uint64_t, std::size_t> sides_;  ///< the triangle to the left of each edge
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open_;
};

}  // namespace

void flip_to_delaunay(std::span<const Vec2> points, Triangles& triangles) { Flips(points, triangles).run(); }

}  // namespace kreisel::core
