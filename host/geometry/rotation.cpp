#include "geometry/rotation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "error.hpp"

namespace kreisel::core {
namespace {

constexpr double turn = 2 * std::numbers::pi;

}  // namespace

Eigen::Matrix3d axis_to_z(const Vec3& axis) {
  const Vec3 from = axis.normalized();
  if (from[2] < -1 + 1e-6) {  // half a turn, about any horizontal axis, and what is left
    const Eigen::DiagonalMatrix<double, 3> half(1, -1, -1);
    return axis_to_z(half * from) * half;
  }
  // The half angle's cosine, and its sine along the axis. Not Eigen's FromTwoVectors, which brings a
  // decomposition along.
  const double cosine = std::sqrt((1 + from[2]) / 2);
  const Vec3 sine = from.cross(Vec3::UnitZ()) / (2 * cosine);
  return Eigen::Quaterniond(cosine, sine[0], sine[1], sine[2]).normalized().toRotationMatrix();
}

Eigen::Matrix3d axes_along(const Vec3& direction) {
  const Vec3 u = direction.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << u.transpose(), direction.cross(u).transpose(), direction.transpose();
  return axes;
}

Vec3 uniform_direction(double u, double v) {
  const double z = 2 * u - 1, r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(turn * v), r * std::sin(turn * v), z};
}

Eigen::Quaterniond uniform_rotation(double u, double v, double w) {
  const double a = std::sqrt(1 - u), b = std::sqrt(u);
  return {b * std::cos(turn * w), a * std::sin(turn * v), a * std::cos(turn * v), b * std::sin(turn * w)};
}

std::vector<Vec3> sphere_directions(int n) {
  if (n < 1) throw InputError(fmt::format("{} axes; expected 1 or more", n));
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2.0 * i + 1) / n, r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(golden_angle * i), r * std::sin(golden_angle * i), z);
  }
  return directions;
}

}  // namespace kreisel::core
