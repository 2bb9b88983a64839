// blend.hpp - solids to draw with: fields that are negative inside, and their smooth union and intersection.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core::blend {

/// Distance to a ball.
inline double ball(const Vec3& p, const Vec3& centre, double radius) { return (p - centre).norm() - radius; }

/// About the distance to an ellipsoid along the axes; exact to first order at its surface.
inline double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& semi_axes) {
  const Vec3 q = (p - centre).cwiseQuotient(semi_axes);
  const double k = q.norm(), slope = q.cwiseQuotient(semi_axes).norm();
  return slope > 1e-12 ? k * (k - 1) / slope : -semi_axes.minCoeff();
}

/// Distance to the convex hull of two balls, neither of which holds the other.
inline double cone(const Vec3& p, const Vec3& a, double ra, const Vec3& b, double rb) {
  const double length = (b - a).norm();
  const Vec3 axis = (b - a) / length;
  const double along = (p - a).dot(axis), beside = (p - a - along * axis).norm();
  const double sine = (ra - rb) / length, cosine = std::sqrt(1 - sine * sine);
  const double foot = along - beside * sine / cosine;  // where the normal of the side meets the axis
  if (foot <= 0) return ball(p, a, ra);
  if (foot >= length) return ball(p, b, rb);
  return along * sine + beside * cosine - ra;
}

/// Union; where the two fields differ by less than `width` the seam is filled, by width / 4 at most.
inline double join(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0);
  return std::min(a, b) - h * h / (4 * width);
}

/// Intersection, its edge rounded in the same way.
inline double meet(double a, double b, double width) { return -join(-a, -b, width); }

/// A point of a tube: centre and radius.
struct Bead {
  Vec3 centre;
  double radius;
};

/// A bent tube of changing thickness: cones from bead to bead along a smooth curve through the given ones.
class Tube {
 public:
  /// @param given  at least two; a Catmull-Rom curve leads through them
  explicit Tube(std::span<const Bead> given) {
    constexpr int pieces = 5;
    const auto at = [&](std::ptrdiff_t i) {
      const Bead& b = given[std::size_t(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(given) - 1))];
      return Eigen::Vector4d(b.centre.x(), b.centre.y(), b.centre.z(), b.radius);
    };
    for (std::ptrdiff_t i = 0; i + 1 < std::ssize(given); ++i)
      for (int k = i ? 1 : 0; k <= pieces; ++k) {
        const double t = double(k) / pieces;
        const Eigen::Vector4d p = at(i), q = at(i + 1), dp = (q - at(i - 1)) / 2, dq = (at(i + 2) - p) / 2;
        const Eigen::Vector4d b =
            p + t * (dp + t * (3 * (q - p) - 2 * dp - dq + t * (2 * (p - q) + dp + dq)));
        beads_.push_back({b.head<3>(), b[3]});
      }
    for (const Bead& b : beads_) around_.centre += b.centre / double(beads_.size());
    for (const Bead& b : beads_)
      around_.radius = std::max(around_.radius, (b.centre - around_.centre).norm() + b.radius);
  }

  double operator()(const Vec3& p) const {
    double field = 1e300;
    for (std::size_t i = 1; i < beads_.size(); ++i)
      field = std::min(
          field, cone(p, beads_[i - 1].centre, beads_[i - 1].radius, beads_[i].centre, beads_[i].radius));
    return field;
  }

  /// join(other, the tube, width); does not look at the cones where the tube is too far to matter.
  [[nodiscard]] double joined_to(double other, const Vec3& p, double width) const {
    if (ball(p, around_.centre, around_.radius) >= other + width) return other;
    return join(other, (*this)(p), width);
  }

 private:
  std::vector<Bead> beads_;
  Bead around_{Vec3::Zero(), 0};
};

/// The same point on the side x >= 0: what is drawn there appears on both sides.
inline Vec3 mirrored(const Vec3& p) { return {std::abs(p.x()), p.y(), p.z()}; }

}  // namespace kreisel::core::blend
