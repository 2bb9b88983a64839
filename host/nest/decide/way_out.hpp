// way_out.hpp - can one point of B be taken out, and up to which scale?
#pragma once

#include "mesh/query/surface_rays.hpp"
#include "nest/decide/nesting.hpp"

namespace kreisel::core::nest {

/// A point b of B at all scales: p(s) = c + s R b. It can be taken out when the segment from p(s) back along
/// the removal direction to the cut lies inside A.
class WayOut {
 public:
  WayOut(const SurfaceRays& rays, const Placement& placement) : rays_(&rays), placement_(&placement) {}

  [[nodiscard]] Vec3 at(const Vec3& b, double scale) const {
    return placement_->pose.centroid + scale * (placement_->pose.rotation * b);
  }
  /// A point outside A on the way from p(s) to the cut, if there is one.
  [[nodiscard]] std::optional<Vec3> gap(const Vec3& b, double scale) const;
  /// The largest scale up to `scale` at which b can be taken out, or one smaller by less than `step` for each
  /// gap on the way; at most `enough` when there is none above that.
  [[nodiscard]] double largest_scale(const Vec3& b, double scale, double enough, double step) const;

 private:
  [[nodiscard]] bool centre_inside() const;
  [[nodiscard]] int half_of(const Vec3& p) const { return placement_->cut.beyond(0, p) >= 0 ? 0 : 1; }

  const SurfaceRays* rays_;
  const Placement* placement_;
};

}  // namespace kreisel::core::nest
