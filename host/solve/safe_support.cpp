#include "solve/safe_support.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kreisel::core {
namespace {

constexpr double eps = 0x1p-53;
constexpr std::size_t block = 256;  // intervals summed one after the other; then the blocks' sums

/// Where c + b z + a z^2 may change its sign between the ends, upwards: at most two places.
std::pair<double, double> roots(double a, double b, double c, double lower, double upper) {
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant > 0)) return {lower, lower};
  const double d = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  // A root at infinity, or none where d = 0 = c, is none between the ends.
  const double first = a != 0 ? d / a : lower, second = d != 0 ? c / d : lower;
  const auto [low, high] = std::minmax(first, second);
  return {std::clamp(low, lower, upper), std::clamp(high, lower, upper)};
}

}  // namespace

SafeSupport::SafeSupport(Rays rays, const MassModel& mass) : rays_(std::move(rays)), mass_(mass) {
  const std::size_t n = rays_.columns.size();
  chain_ = static_cast<double>(3 * std::min(block, n) + n / block + 1);
  const double h = rays_.grid.h;
  size_.setZero();
  for (std::size_t i = 0; i < n; ++i) {
    const double x = std::abs(rays_.grid.centre(0, static_cast<int>(rays_.columns[i] & 0xffffu))),
                 y = std::abs(rays_.grid.centre(1, static_cast<int>(rays_.columns[i] >> 16))),
                 z = std::max(std::abs(rays_.lower[i]), std::abs(rays_.upper[i]));
    Moments t;
    t << 1, x, y, z, x * y, y * z, x * z, x * x + h * h / 12, y * y + h * h / 12, z * z;
    size_ += h * h * (rays_.upper[i] - rays_.lower[i]) * t;
  }
  size_ = mass_.fixed.cwiseAbs() + mass_.contrast * size_;
}

SafeSupport::Value SafeSupport::at(const Moments& q) const {
  const double h = rays_.grid.h, hh = h * h / 12;
  const std::size_t n = rays_.columns.size();
  Moments all = Moments::Zero();
  for (std::size_t begin = 0; begin < n; begin += block) {
    Moments sum = Moments::Zero();
    for (std::size_t i = begin; i < std::min(n, begin + block); ++i) {
      const double x = rays_.grid.centre(0, static_cast<int>(rays_.columns[i] & 0xffffu)),
                   y = rays_.grid.centre(1, static_cast<int>(rays_.columns[i] >> 16)), xx = x * x + hh,
                   yy = y * y + hh;
      const double a = q[SZZ], b = q[SZ] + q[SYZ] * y + q[SXZ] * x,
                   c = q[S1] + q[SX] * x + q[SY] * y + q[SXY] * x * y + q[SXX] * xx + q[SYY] * yy;
      const auto [first, second] = roots(a, b, c, rays_.lower[i], rays_.upper[i]);
      const double ends[] = {rays_.lower[i], first, second, rays_.upper[i]};
      for (int part = 0; part < 3; ++part) {
        const double z0 = ends[part], z1 = ends[part + 1], z = (z0 + z1) / 2;
        if (!(z1 > z0) || !(c + z * (b + a * z) < 0)) continue;
        const double length = z1 - z0, middle = z * length;
        Moments t;
        t << length, x * length, y * length, middle, x * y * length, y * middle, x * middle, xx * length,
            yy * length, length * (z0 * z0 + z0 * z1 + z1 * z1) / 3;
        sum += t;
      }
    }
    all += sum;
  }
  Value value;
  value.s = mass_.total(h * h * all);
  value.h = q.dot(value.s);
  value.margin = (chain_ + 32) * eps * q.cwiseAbs().dot(size_);
  return value;
}

SafeSupport::Value SafeSupport::at(const Moments& q, double offset) const {
  Value value = at(q);
  value.h += offset;
  value.margin += 2 * eps * std::abs(offset);  // of the offset itself, a product, and of the sum
  return value;
}

bool SafeSupport::certainly_positive(const Moments& q, double offset) const {
  const Value value = at(q, offset);
  return value.h >= 2 * value.margin;
}

std::optional<double> SafeSupport::largest_ratio(const Moments& numerator, const Moments& denominator,
                                                 double t, double offset) const {
  // Newton's method is Dinkelbach's here: it falls to the root from above, from its second iterate on.
  Value value{};
  for (int step = 0; step < 20; ++step) {
    value = at(numerator - t * denominator, offset);
    const double change = (value.h - 2 * value.margin) / denominator.dot(value.s);
    if (!std::isfinite(change)) return std::nullopt;
    if (change >= 0 && step > 0) return t;
    t += change;
    if (std::abs(change) <= 4 * eps * std::abs(t)) break;
  }
  // What counts is the sign as it is computed; each further step is twice as long.
  double step = std::max(value.margin / denominator.dot(value.s), 4 * eps * std::abs(t));
  for (int trial = 0; trial < 60; ++trial, t -= step, step *= 2)
    if (certainly_positive(numerator - t * denominator, offset)) return t;
  return std::nullopt;
}

}  // namespace kreisel::core
