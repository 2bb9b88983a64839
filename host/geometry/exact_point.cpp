#include "geometry/exact_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/single_precision.hpp"

namespace kreisel::core {
namespace {

using Numbers = std::array<mpq_class, 3>;
using Whole = std::array<mpz_class, 3>;

constexpr double unit = std::numeric_limits<double>::epsilon();  // 2^-52

Numbers numbers(const Vec3& p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }

Numbers minus(const Numbers& a, const Numbers& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

mpq_class dot(const Numbers& a, const Numbers& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Numbers cross(const Numbers& a, const Numbers& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Whole cross(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpz_class dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Without common divisors to look for, which is what takes the time of rational numbers.
mpz_class plane_determinant(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int axis) {
  const auto i = std::size_t((axis + 1) % 3), j = std::size_t((axis + 2) % 3);
  const auto &p = a.homogeneous(), &q = b.homogeneous(), &r = c.homogeneous();
  return p[3] * (q[i] * r[j] - q[j] * r[i]) + q[3] * (r[i] * p[j] - r[j] * p[i]) +
         r[3] * (p[i] * q[j] - p[j] * q[i]);
}

/// A power of two that makes whole numbers of all coordinates.
int exponent_of(std::initializer_list<Vec3> points) {
  int exponent = 0;
  for (const Vec3& p : points)
    for (const double x : p)
      if (x != 0) exponent = std::max(exponent, std::numeric_limits<double>::digits - std::ilogb(x));
  return exponent;
}

/// x times 2^exponent, however large.
mpz_class whole(double x, int exponent) {
  constexpr int digits = std::numeric_limits<double>::digits;
  int own = 0;
  const mpz_class digits_of_x(std::ldexp(std::frexp(x, &own), digits));
  return digits_of_x << (own - digits + exponent);
}

Whole whole(const Vec3& p, int exponent) {
  return {whole(p[0], exponent), whole(p[1], exponent), whole(p[2], exponent)};
}

/// (a - p) times the point's denominator and 2^exponent. @param a  times 2^exponent
Whole from(const ExactPoint& p, const Whole& a, int exponent) {
  const auto& h = p.homogeneous();
  Whole d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = a[i] * h[3] - (h[i] << exponent);
  return d;
}

/// How far a difference of two coordinates may be off that are known to within 2^-52 of themselves.
double difference_error(const Vec3& a, const Vec3& b) {
  return 4 * unit * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
}

/// How far a . (b x c) may be off in double, when no component of a is off by more than ea, and so on. Twice
/// what a count of the roundings gives.
double triple_error(const Vec3& a, double ea, const Vec3& b, double eb, const Vec3& c, double ec) {
  const double x = a.cwiseAbs().maxCoeff(), y = b.cwiseAbs().maxCoeff(), z = c.cwiseAbs().maxCoeff();
  return 12 * ((x + ea) * (y + eb) * (z + ec) - x * y * z) + 96 * unit * x * y * z;
}

/// a + t (b - a)
ExactPoint along(const Numbers& a, const Numbers& b, const mpq_class& t) {
  Numbers p = minus(b, a);
  for (std::size_t i = 0; i < 3; ++i) p[i] = a[i] + t * p[i];
  return ExactPoint(p);
}

/// The one of three neighbouring numbers that is nearest, the middle one in case of a tie.
template <class Number>
double nearest(Number first, const mpq_class& exact) {
  constexpr Number infinity = std::numeric_limits<Number>::infinity();
  double best = double(first);
  mpq_class distance = abs(mpq_class(best) - exact);
  for (const Number other : {std::nextafter(first, -infinity), std::nextafter(first, infinity)}) {
    if (!std::isfinite(other)) continue;
    const mpq_class d = abs(mpq_class(double(other)) - exact);
    if (d >= distance) continue;
    best = double(other);
    distance = d;
  }
  return best;
}

}  // namespace

ExactPoint::ExactPoint(const Vec3& p) : ExactPoint(numbers(p)) {}

ExactPoint::ExactPoint(const std::array<mpq_class, 3>& p) : near_(p[0].get_d(), p[1].get_d(), p[2].get_d()) {
  mpz_class& denominator = homogeneous_[3];
  denominator = lcm(lcm(p[0].get_den(), p[1].get_den()), p[2].get_den());
  for (std::size_t i = 0; i < 3; ++i) homogeneous_[i] = p[i].get_num() * (denominator / p[i].get_den());
}

std::array<mpq_class, 3> ExactPoint::exact() const {
  Numbers p;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = mpq_class(homogeneous_[i], homogeneous_[3]);
    p[i].canonicalize();
  }
  return p;
}

bool ExactPoint::operator<(const ExactPoint& other) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (const int side =
            cmp(homogeneous_[i] * other.homogeneous_[3], other.homogeneous_[i] * homogeneous_[3]))
      return side < 0;
  return false;
}

Vec3 ExactPoint::rounded(bool to_single) const {
  Vec3 p;
  const Numbers numbers = exact();
  for (int i = 0; i < 3; ++i) {
    const mpq_class& x = numbers[std::size_t(i)];
    p[i] = to_single ? nearest(float(in_single_precision(near_[i])), x) : nearest(near_[i], x);
  }
  return p;
}

int orient2d(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Vec3 u = b.near() - a.near(), v = c.near() - a.near();
  const double det = u[i] * v[j] - u[j] * v[i];
  const double e = std::max(difference_error(a.near(), b.near()), difference_error(a.near(), c.near()));
  const double x = std::max(std::abs(u[i]), std::abs(u[j])), y = std::max(std::abs(v[i]), std::abs(v[j]));
  if (std::abs(det) > 4 * e * (x + y + e) + 8 * unit * x * y) return det > 0 ? 1 : -1;
  return sgn(plane_determinant(a, b, c, axis));
}

int orient3d(const std::array<Vec3, 3>& triangle, const ExactPoint& p) {
  const auto& [a, b, c] = triangle;
  const Vec3 u = b - a, v = c - a, w = p.near() - a;
  const double det = w.dot(u.cross(v));
  const double bound =
      triple_error(w, difference_error(a, p.near()), u, difference_error(a, b), v, difference_error(a, c));
  if (std::abs(det) > bound) return det > 0 ? 1 : -1;
  const int exponent = exponent_of({a, b, c});
  const Whole of_a = whole(a, exponent), of_b = whole(b, exponent), of_c = whole(c, exponent);
  const Whole normal = cross(Whole{of_b[0] - of_a[0], of_b[1] - of_a[1], of_b[2] - of_a[2]},
                             Whole{of_c[0] - of_a[0], of_c[1] - of_a[1], of_c[2] - of_a[2]});
  return -sgn(dot(from(p, of_a, exponent), normal));
}

int passes(const ExactPoint& p, const Vec3& direction, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - p.near(), v = b - p.near();
  const double det = direction.dot(u.cross(v));
  const double bound =
      triple_error(direction, 0, u, difference_error(a, p.near()), v, difference_error(b, p.near()));
  if (std::abs(det) > bound) return det > 0 ? 1 : -1;
  const int exponent = exponent_of({a, b, direction});
  return sgn(dot(whole(direction, exponent),
                 cross(from(p, whole(a, exponent), exponent), from(p, whole(b, exponent), exponent))));
}

bool between(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  const auto &p = a.homogeneous(), &q = b.homogeneous(), &r = c.homogeneous();
  for (std::size_t i = 0; i < 3; ++i) {
    const int before = cmp(p[i] * q[3], q[i] * p[3]), after = cmp(q[i] * r[3], r[i] * q[3]);
    if (before * after < 0) return false;
  }
  return true;
}

ExactPoint line_meets_plane(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& triangle) {
  const Numbers a = numbers(triangle[0]), from = numbers(p), to = numbers(q);
  const Numbers normal = cross(minus(numbers(triangle[1]), a), minus(numbers(triangle[2]), a));
  const mpq_class before = dot(normal, minus(a, from)), length = dot(normal, minus(to, from));
  return along(from, to, before / length);
}

ExactPoint lines_meet(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d,
                      int axis) {
  // Each is the determinant times the denominators of its points.
  const mpz_class of_a = plane_determinant(c, d, a, axis) * b.homogeneous()[3];
  const mpz_class of_b = plane_determinant(c, d, b, axis) * a.homogeneous()[3];
  mpq_class t(of_a, of_a - of_b);
  t.canonicalize();
  return along(a.exact(), b.exact(), t);
}

ExactPoint middle_of(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  const Numbers p = a.exact(), q = b.exact(), r = c.exact();
  Numbers mean;
  for (std::size_t i = 0; i < 3; ++i) mean[i] = (p[i] + q[i] + r[i]) / 3;
  return ExactPoint(mean);
}

}  // namespace kreisel::core
