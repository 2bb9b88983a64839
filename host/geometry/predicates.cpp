#include "geometry/predicates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kreisel::core {
namespace {

int sign(double x) { return (x > 0) - (x < 0); }

/// A sum of doubles without rounding: components that do not overlap, smallest first.
class ExactSum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double e = parts_[i], sum = x + e, virtual_e = sum - x;
      const double error = (x - (sum - virtual_e)) + (e - virtual_e);
      if (error != 0) parts_[kept++] = error;
      x = sum;
    }
    if (x != 0) parts_[kept++] = x;
    count_ = kept;
  }

  void add_product(double a, double b) {
    const double p = a * b;
    add(p);
    add(std::fma(a, b, -p));
  }

  void add_product(double a, double b, double c) {
    const double p = a * b;
    add_product(p, c);
    add_product(std::fma(a, b, -p), c);
  }

  /// The largest component outweighs all others together.
  [[nodiscard]] int sign() const { return count_ ? kreisel::core::sign(parts_[count_ - 1]) : 0; }

 private:
  // 24 products of three doubles have four components each.
  std::array<double, 96> parts_;
  std::size_t count_ = 0;
};

/// Adds or subtracts det(p, q, r).
void add_determinant(ExactSum& sum, double factor, const Vec3& p, const Vec3& q, const Vec3& r) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum.add_product(factor * p[i], q[j], r[k]);
    sum.add_product(-factor * p[i], q[k], r[j]);
  }
}

// On the way from a coordinate to the sum lie at most eight roundings: difference, two products, difference
// of the minor, two sums, and as many again for those of the bound itself; 2^-53 each.
constexpr double rounding = 16 * 0.5 * std::numeric_limits<double>::epsilon();

}  // namespace

int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  const double det = left - right;
  if (std::abs(det) > rounding * (std::abs(left) + std::abs(right))) return sign(det);
  ExactSum sum;
  sum.add_product(a[0], b[1]);
  sum.add_product(-a[1], b[0]);
  sum.add_product(b[0], c[1]);
  sum.add_product(-b[1], c[0]);
  sum.add_product(c[0], a[1]);
  sum.add_product(-c[1], a[0]);
  return sum.sign();
}

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  double det = 0, bound = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double forward = u[j] * v[k], backward = u[k] * v[j];
    det += w[i] * (forward - backward);
    bound += std::abs(w[i]) * (std::abs(forward) + std::abs(backward));
  }
  if (std::abs(det) > rounding * bound) return sign(det);
  ExactSum sum;
  add_determinant(sum, 1, b, c, d);
  add_determinant(sum, -1, a, c, d);
  add_determinant(sum, 1, a, b, d);
  add_determinant(sum, -1, a, b, c);
  return sum.sign();
}

int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a).cwiseAbs();
  std::array<int, 3> axes{0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int i, int j) { return normal[i] > normal[j]; });
  for (const int axis : axes)
    if (orient2d(drop(a, axis), drop(b, axis), drop(c, axis)) != 0) return axis;
  return -1;
}

}  // namespace kreisel::core
