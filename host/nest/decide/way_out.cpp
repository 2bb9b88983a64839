#include "nest/decide/way_out.hpp"

#include <algorithm>
#include <limits>

namespace kreisel::core::nest {
namespace {

constexpr double far = 4;  // longer than any way in nesting units
// SurfaceRays go on this far behind a hit, and what is thinner than a gap is left to pairs of triangles,
// which are exact.
constexpr double past = 4e-7, thin = 1e-5;

}  // namespace

std::optional<Vec3> WayOut::gap(const Vec3& b, double scale) const {
  const Cut& cut = placement_->cut;
  const Vec3 p = at(b, scale);
  if (p.squaredNorm() > 1) return p;  // A lies in the unit ball
  const int half = half_of(p);
  const Vec3 back = -cut.removal(half);
  const double length = cut.beyond(half, p) / std::abs(cut.normal.dot(back));
  auto hit = rays_->first(p, back, 0, length);
  if (!hit) {
    const auto ahead = rays_->first(p, -back, 0, far);
    return ahead && ahead->out ? std::nullopt : std::optional(p);
  }
  if (!hit->out && hit->distance > thin) return p;
  while (hit) {
    const auto next = rays_->first(p, back, hit->distance + past, length);
    const double end = next ? next->distance : length;
    // Out twice running: the gap between was thinner than a ray can tell.
    if (hit->out && !(next && next->out) && end - hit->distance > thin)
      return p + 0.5 * (hit->distance + end) * back;
    hit = next;
  }
  return std::nullopt;
}

bool WayOut::centre_inside() const {
  const Vec3& centre = placement_->pose.centroid;
  const auto ahead = rays_->first(centre, placement_->cut.plus, 0, far);
  return ahead && ahead->out;
}

double WayOut::largest_scale(const Vec3& b, double scale, double enough, double step) const {
  const Cut& cut = placement_->cut;
  const Vec3& centre = placement_->pose.centroid;
  while (scale > enough) {
    const auto q = gap(b, scale);
    if (!q) return scale;
    // c + f (q - c) is on the way of p(f s), for the way keeps its direction; it is beyond the cut as long as
    const int half = half_of(*q);
    const double above = cut.beyond(half, *q), below = cut.beyond(half, centre);
    const double to_cut = below < 0 && above > below ? -below / (above - below) : 0;
    const auto hit = rays_->first(*q, centre - *q, 0, 1);
    // A way from outside to a centroid inside that crosses nothing begins on the surface, up to rounding.
    const double crossed = hit ? 1 - hit->distance : centre_inside() ? 1 : 0;
    scale = std::min(scale * std::max(to_cut, crossed), scale - step);
  }
  return scale;
}

}  // namespace kreisel::core::nest
