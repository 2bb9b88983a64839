#include "nest/plane/radial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace kreisel::core::nest {

Radial::Radial(const std::vector<Vec2>& directions)
    : directions_(directions),
      slots_(1, std::vector<float>(directions.size())),
      count_(directions.size()),
      begin_(directions.size()) {}

void Radial::see(std::span<const Vec2> polygon, const Vec2& from) {
  const int n = static_cast<int>(directions_.size());
  std::ranges::fill(count_, 0);
  std::ranges::fill(slots_.front(), std::numeric_limits<float>::infinity());
  several_.clear();
  // The first direction at or beyond a vertex. Edges share it, so no ray passes between two of them.
  const auto first_beyond = [n](const Vec2& p) {
    const double turn = std::atan2(p.y(), p.x()) / (2 * std::numbers::pi);
    return static_cast<int>(std::ceil((turn < 0 ? turn + 1 : turn) * n)) % n;
  };
  Vec2 a = polygon.back() - from;
  int i = first_beyond(a);
  for (const Vec2& vertex : polygon) {
    const Vec2 b = vertex - from;
    const int j = first_beyond(b);
    const double turn = cross(a, b);  // the edge turns this way about the point
    int count = turn > 0 ? j - i : i - j, d = turn > 0 ? i : j;
    if (count < 0) count += n;
    // An edge spans less than half a turn; one that round-off made run backwards none at all.
    if (turn != 0 && 2 * count <= n + 2) {
      const Vec2 along = b - a;
      const double far = std::max(a.norm(), b.norm());  // round-off, where the edge points at the point
      for (; count > 0; --count, d = d + 1 == n ? 0 : d + 1) {
        const Vec2& u = directions_[static_cast<std::size_t>(d)];
        const auto t = static_cast<float>(std::min(far, std::abs(turn / cross(u, along))));
        const auto at = static_cast<std::size_t>(d);
        const int have = count_[at]++;
        if (have == 1) several_.push_back(d);
        if (have >= static_cast<int>(slots_.size())) slots_.emplace_back(directions_.size());
        // The nearest goes first, the others in any order for now.
        slots_[static_cast<std::size_t>(have)][at] = have ? std::max(t, slots_[0][at]) : t;
        slots_[0][at] = std::min(t, slots_[0][at]);
      }
    }
    a = b;
    i = j;
  }
  std::ranges::sort(several_);
  sorted_.clear();
  for (const int direction : several_) {
    const auto at = static_cast<std::size_t>(direction);
    begin_[at] = sorted_.size();
    for (int k = 0; k < count_[at]; ++k) sorted_.push_back(slots_[static_cast<std::size_t>(k)][at]);
    std::ranges::sort(std::span(sorted_).subspan(begin_[at]));
  }
}

std::span<const float> Radial::crossings(int direction) const {
  const auto at = static_cast<std::size_t>(direction);
  const auto count = static_cast<std::size_t>(count_[at]);
  return count <= 1 ? std::span(slots_.front()).subspan(at, count)
                    : std::span(sorted_).subspan(begin_[at], count);
}

}  // namespace kreisel::core::nest
