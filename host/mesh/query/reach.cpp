#include "mesh/query/reach.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace kreisel::core::reach {

void Footprint::head(double hx, double hy) {
  const double length = std::hypot(hx, hy);
  if (length < no_slope) return;
  ux = hx / length;
  uy = hy / length;
}

std::pair<double, double> Footprint::rows() const {
  double lo = infinity, hi = -infinity;
  for (const double a : along)
    for (const double c : across) {
      const double v = y + uy * a + ux * c;
      lo = std::min(lo, v);
      hi = std::max(hi, v);
    }
  return {lo, hi};
}

std::pair<double, double> Footprint::columns(double row) const {
  // A strip nearly along the row says little of x; the other one does.
  constexpr double steep = 1e-3;
  const double dy = row - y;
  double lo = -infinity, hi = infinity;
  const auto within = [&](const double range[2], double cx, double cy) {
    if (std::abs(cx) < steep) return;
    const double p = (range[0] - cy * dy) / cx, q = (range[1] - cy * dy) / cx;
    lo = std::max(lo, std::min(p, q));
    hi = std::min(hi, std::max(p, q));
  };
  within(along, ux, uy);
  within(across, -uy, ux);
  return {x + lo, x + hi};
}

void HalfSpaces::require(const Vec3& normal, double offset) {
  const double nz = normal[2];
  if (std::abs(nz) < no_slope) {
    beside_[beside_count_++] = {offset, normal[0], normal[1]};
    return;
  }
  const Linear z{origin_[2] - offset / nz, -normal[0] / nz, -normal[1] / nz};
  (nz > 0 ? above_[above_count_++] : below_[below_count_++]) = z;
}

Cylinder::Cylinder(const Vec3& a, const Vec3& b, double radius) : a_(a), radius_(radius), ends_(a) {
  const Vec3 edge = b - a;
  const double length = edge.stableNorm();
  const Vec3 unit = edge / length;
  ends_.require(unit, 0);
  ends_.require(-unit, length);

  const double run = std::hypot(unit[0], unit[1]);
  if (run >= no_slope) {
    run_ = run;
    rise_ = unit[2];
  }
  shadow_.x = a[0];
  shadow_.y = a[1];
  shadow_.head(unit[0], unit[1]);
  // Seen from above a disc across the edge is an ellipse, as narrow as the edge is flat.
  const double narrow = radius * std::abs(unit[2]);
  shadow_.along[0] = -narrow;
  shadow_.along[1] = length * run + narrow;
  shadow_.across[0] = -radius;
  shadow_.across[1] = radius;
}

Prism::Prism(const Vec3& p, const Vec3& q, const Vec3& r, double radius) : sides_(p) {
  // Everything hangs on the longest edge: a needle's normal, a cross product of two nearly parallel edges,
  // would be right about none of its corners.
  Vec3 a = p, b = q, c = r;
  for (int turn = 0; turn < 2; ++turn)
    if ((b - a).squaredNorm() < std::max((c - b).squaredNorm(), (a - c).squaredNorm())) {
      const Vec3 first = a;
      a = b;
      b = c;
      c = first;
    }
  sides_ = HalfSpaces(a);
  const double length = (b - a).stableNorm();
  const Vec3 e = (b - a) / length;
  const double foot = (c - a).dot(e);
  const Vec3 altitude = (c - a) - foot * e;
  const double height = altitude.stableNorm();
  flat_ = !(length > 0) || !(height > 0);
  if (flat_) return;
  const Vec3 n = e.cross(altitude / height).normalized();
  const Vec3 m = n.cross(e);

  sides_.require(n, radius);
  sides_.require(-n, radius);
  sides_.require(m, 0);
  const double ac = std::hypot(height, foot), bc = std::hypot(height, length - foot);
  sides_.require(height / ac * e - foot / ac * m, 0);
  sides_.require(-height / bc * e - (length - foot) / bc * m, height / bc * length);

  shadow_.x = a[0];
  shadow_.y = a[1];
  // A small steep triangle leaves a long narrow shadow along its normal; a flat one is as it lies.
  if (const double lean = std::hypot(n[0], n[1]); lean * radius > 0.1 * length)
    shadow_.head(n[0], n[1]);
  else
    shadow_.head(e[0], e[1]);
  const auto range = [&](double(&out)[2], double ux, double uy) {
    const auto at = [&](const Vec3& v) { return ux * (v[0] - a[0]) + uy * (v[1] - a[1]); };
    const double wide = radius * std::abs(ux * n[0] + uy * n[1]);
    const auto [lo, hi] = std::minmax({0.0, at(b), at(c)});
    out[0] = lo - wide;
    out[1] = hi + wide;
  };
  range(shadow_.along, shadow_.ux, shadow_.uy);
  range(shadow_.across, -shadow_.uy, shadow_.ux);
}

}  // namespace kreisel::core::reach
