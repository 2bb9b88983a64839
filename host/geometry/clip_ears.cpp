#include "geometry/clip_ears.hpp"

#include <algorithm>

#include "geometry/predicates.hpp"

namespace kreisel::core {
namespace {

using Point = Vec2;

class Ears {
 public:
  Ears(std::span<const Point> points, std::span<const std::uint32_t> polygon)
      : points_(points), at_(polygon.begin(), polygon.end()), next_(polygon.size()), last_(polygon.size()) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      last_[(i + 1) % n] = i;
    }
  }

  std::optional<std::vector<std::array<std::uint32_t, 3>>> clip() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t left = at_.size(), i = 0, tried = 0;
    while (left > 3) {
      if (tried > left) return std::nullopt;
      if (point(last_[i]) == point(next_[i])) {  // there and back, with triangles on both sides or none
        unlink(next_[i]);
        unlink(i);
        i = last_[i];
        left -= 2;
        tried = 0;
      } else if (is_ear(i)) {
        triangles.push_back({at_[last_[i]], at_[i], at_[next_[i]]});
        unlink(i);
        i = next_[next_[i]];  // not the neighbour: slivers would fan out from one point
        --left;
        tried = 0;
      } else {
        i = next_[i];
        ++tried;
      }
    }
    if (left == 3) {
      if (orient2d(point(last_[i]), point(i), point(next_[i])) < 0) return std::nullopt;
      triangles.push_back({at_[last_[i]], at_[i], at_[next_[i]]});
    }
    return triangles;
  }

 private:
  [[nodiscard]] const Point& point(std::size_t i) const { return points_[at_[i]]; }
  void unlink(std::size_t i) {
    next_[last_[i]] = next_[i];
    last_[next_[i]] = last_[i];
  }

  [[nodiscard]] bool is_ear(std::size_t i) const {
    const Point &a = point(last_[i]), &b = point(i), &c = point(next_[i]);
    if (orient2d(a, b, c) <= 0) return false;
    const std::array<double, 4> box = {std::min({a[0], b[0], c[0]}), std::max({a[0], b[0], c[0]}),
                                       std::min({a[1], b[1], c[1]}), std::max({a[1], b[1], c[1]})};
    for (std::size_t j = next_[next_[i]]; j != last_[i]; j = next_[j]) {
      const Point& p = point(j);
      if (p[0] < box[0] || p[0] > box[1] || p[1] < box[2] || p[1] > box[3]) continue;
      // A point that is visited twice is no obstacle to its other visit, unless the line turns into the ear
      // there: it then leaves through the cut, for the ear's other two sides are not crossed.
      if (p == a || p == c) continue;
      if (p == b ? goes_between(j, a, b, c) : in_triangle(p, a, b, c)) return false;
    }
    return true;
  }

  /// Does the polygon come or go, at its corner j in b, strictly between the sides of the ear?
  [[nodiscard]] bool goes_between(std::size_t j, const Point& a, const Point& b, const Point& c) const {
    const auto between = [&](const Point& p) { return orient2d(a, b, p) > 0 && orient2d(b, c, p) > 0; };
    return between(point(last_[j])) || between(point(next_[j]));
  }

  std::span<const Point> points_;
  std::vector<std::uint32_t> at_;
  std::vector<std::size_t> next_, last_;
};

}  // namespace

std::optional<std::vector<std::array<std::uint32_t, 3>>> clip_ears(std::span<const Point> points,
                                                                   std::span<const std::uint32_t> polygon) {
  return Ears(points, polygon).clip();
}

}  // namespace kreisel::core
