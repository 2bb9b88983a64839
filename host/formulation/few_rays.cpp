#include "formulation/few_rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kreisel::core {
namespace {

/// The two roots of c + b z + a z^2, in order, as far as they lie between; both at the lower end where there
/// are none. Without cancellation. [Press et al. 2007, Numerical Recipes, s. 5.6]
struct Roots {
  double first, last, slope;  ///< slope: |dq/dz| at both

  Roots(double a, double b, double c, double lower, double upper) {
    const double discriminant = b * b - 4 * a * c;
    if (!(discriminant > 0)) {
      // No change of sign: the sign of c (and of a, which is c's) decides.
      first = lower;
      last = a < 0 || !(c < 0) ? lower : upper;
      slope = 0;
      return;
    }
    slope = std::sqrt(discriminant);
    const double t = -0.5 * (b + std::copysign(slope, b));
    // a = 0 sends the first root to infinity, on the side that q's slope and a's positive zero give it.
    const double one = t / a, other = c / t;
    first = std::max(std::min(std::min(one, other), upper), lower);
    last = std::max(std::min(std::max(one, other), upper), lower);
  }
};

}  // namespace

FewRays::FewRays(const Rays& rays) : h_(rays.grid.h) {
  for (std::size_t i = 0; i < rays.columns.size(); ++i)
    rays_.push_back({rays.grid.centre(0, static_cast<int>(rays.columns[i] & 0xffffu)),
                     rays.grid.centre(1, static_cast<int>(rays.columns[i] >> 16)), rays.lower[i],
                     rays.upper[i]});
}

Support FewRays::operator()(const Moments& q, bool with_hessian) const {
  Support support;
  const double scale = q.cwiseAbs().maxCoeff();
  if (rays_.empty() || !(scale > 0)) return support;
  const double area = h_ * h_, hh = area / 12;
  Moments unit = q / scale;
  unit[S1] += (unit[SXX] + unit[SYY]) * hh;
  if (std::abs(unit[SZZ]) < std::numeric_limits<double>::min()) unit[SZZ] = 0;
  const double a = unit[SZZ];
  for (const Ray& ray : rays_) {
    const double x = ray.x, y = ray.y;
    const double b = unit[SZ] + unit[SYZ] * y + unit[SXZ] * x;
    const double c =
        unit[S1] + (unit[SX] + unit[SXY] * y + unit[SXX] * x) * x + (unit[SY] + unit[SYY] * y) * y;
    const Roots roots(a, b, c, ray.lower, ray.upper);
    const auto add = [&](double z0, double z1) {
      const double length = z1 - z0, sum = z0 + z1, first = length * sum;
      Moments of;
      of << length, length * x, length * y, first, length * x * y, first * y, first * x, length * x * x,
          length * y * y, length * (z0 * z0 + z1 * sum);
      support.moments += of;
    };
    if (a < 0) {  // negative outside the roots
      add(ray.lower, roots.first);
      add(roots.last, ray.upper);
    } else {
      add(roots.first, roots.last);
    }
    if (!with_hessian || !(roots.slope > 0)) continue;
    for (const double z : {roots.first, roots.last}) {
      if (!(z > ray.lower && z < ray.upper)) continue;
      Moments t;
      t << 1, x, y, z, x * y, y * z, x * z, x * x + hh, y * y + hh, z * z;
      support.hessian.noalias() -= (area / (roots.slope * scale)) * t * t.transpose();
    }
  }
  support.moments = columns_of_lines(support.moments, h_);
  support.value = q.dot(support.moments);
  return support;
}

}  // namespace kreisel::core
