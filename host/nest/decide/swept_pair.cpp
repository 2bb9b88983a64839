#include "nest/decide/swept_pair.hpp"

#include <array>
#include <utility>

#include "geometry/triangle.hpp"

namespace kreisel::core::nest {

SweptTriangle::SweptTriangle(const HalfView& view, const Vec3& p, const Vec3& q, const Vec3& r) {
  const std::array<Vec3, 3> corner{p, q, r};
  const Vec3 normal = normal_of(p, q, r);
  const double turn = normal.z() < 0 ? -1 : 1;
  edge_on_ = normal.z() == 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = turn * (corner[(k + 1) % 3] - corner[k]);
    sides_[k] = {Vec3(-along.y(), along.x(), 0), corner[k]};
  }
  sides_[3] = {-turn * normal, p};
  sides_[4] = {view.cut.normal, view.cut.offset * view.cut.normal};
}

std::optional<Vec3> SweptTriangle::common_point(const Vec3& a, const Vec3& b, const Vec3& c) const {
  std::array<Vec3, 8> polygon{a, b, c}, kept;
  std::array<double, 8> depth{};
  std::size_t n = 3;
  for (const HalfSpace& side : sides_) {
    bool all = true, none = true;
    for (std::size_t i = 0; i < n; ++i) {
      depth[i] = side(polygon[i]);
      (depth[i] >= 0 ? none : all) = false;
    }
    if (none) return std::nullopt;
    if (all) continue;
    std::size_t m = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 == n ? 0 : i + 1;
      if (depth[i] >= 0) kept[m++] = polygon[i];
      if ((depth[i] > 0 && depth[j] < 0) || (depth[i] < 0 && depth[j] > 0))
        kept[m++] = polygon[i] + depth[i] / (depth[i] - depth[j]) * (polygon[j] - polygon[i]);
    }
    std::swap(polygon, kept);
    n = m;
  }
  return polygon[0];
}

}  // namespace kreisel::core::nest
