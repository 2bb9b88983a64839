#include "physics/steady_spin.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "body/frame.hpp"

namespace kreisel::core {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;

/// e lambda^4 + b lambda^2 + c = 0, e > 0: how small deviations behave.
struct Characteristic {
  double e, b, c;
  bool least;  ///< the amended potential is at a minimum: nothing can grow, whatever round-off says

  [[nodiscard]] double growth() const {
    if (least) return 0;
    const double discriminant = b * b - 4 * e * c;
    if (discriminant < 0)  // two pairs of complex squares: one root of each grows
      return std::sqrt((std::sqrt(c / e) - b / (2 * e)) / 2);
    const double square = (-b + std::sqrt(discriminant)) / (2 * e);
    return square > 0 ? std::sqrt(square) : 0;
  }
};

/// The body seen from its vertical: rotated so that u = z.
struct Upright {
  Matrix3d inertia;
  Vec3 lever;
  double per_mass, square;  ///< of the speed

  [[nodiscard]] Vector2d slope() const { return lever.head<2>() - square * inertia.topRightCorner<2, 1>(); }
  /// Derivative of slope() as u moves on the sphere, at the same speed.
  [[nodiscard]] Matrix2d turning() const {
    return (square * inertia(2, 2) - lever[2]) * Matrix2d::Identity() -
           square * inertia.topLeftCorner<2, 2>();
  }

  /// Routh's reduction: mass matrix, gyroscopic term and Hessian of the amended potential on the sphere of
  /// verticals, at the momentum of the steady spin.
  [[nodiscard]] Characteristic characteristic() const {
    const Vector2d side = inertia.topRightCorner<2, 1>(), arm(lever[1], -lever[0]);
    const double axial = inertia(2, 2);
    const Matrix2d mass =
        inertia.topLeftCorner<2, 2>() - side * side.transpose() / axial + per_mass * arm * arm.transpose();
    const Matrix2d stiffness = turning() + 4 * square / axial * side * side.transpose();
    const double gyroscopic = 2 * inertia.col(2).squaredNorm() / axial - inertia.trace();
    return {mass.determinant(), (mass * stiffness).trace() + square * gyroscopic * gyroscopic,
            stiffness.determinant(), stiffness.determinant() > 0 && stiffness.trace() > 0};
  }
};

Upright seen_from(const RigidBody& body, const Vec3& up, double speed) {
  const Matrix3d r = axis_to_z(up);
  return {r * body.inertia * r.transpose(), r * body.lever, body.per_mass, speed * speed};
}

}  // namespace

std::optional<SteadySpin> steady_spin(const RigidBody& body, double speed, double most_tilt) {
  SteadySpin steady;
  constexpr int most = 30;
  for (int iteration = 0; iteration < most; ++iteration) {  // Newton on the sphere
    const Upright seen = seen_from(body, steady.up, speed);
    const double scale = seen.lever.norm() + seen.square * seen.inertia.norm();
    if (seen.slope().norm() <= 1e-13 * scale) {
      steady.tilt = std::atan2(steady.up.head<2>().norm(), steady.up[2]);
      if (steady.tilt > most_tilt) return std::nullopt;
      steady.growth = seen.characteristic().growth();
      return steady;
    }
    const Vector2d move = -seen.turning().inverse() * seen.slope();
    if (!move.allFinite()) return std::nullopt;
    const Vec3 next = Vec3(move[0], move[1], 1).normalized();
    steady.up = (axis_to_z(steady.up).transpose() * next).normalized();
  }
  return std::nullopt;
}

std::vector<SpeedRange> stable_speeds(const RigidBody& body) {
  const double mean = (body.inertia(0, 0) + body.inertia(1, 1)) / 2,
               apart = std::hypot((body.inertia(0, 0) - body.inertia(1, 1)) / 2, body.inertia(0, 1));
  const double a = mean - apart, b = mean + apart, c = body.inertia(2, 2);  // principal moments
  const double p = body.lever[2];
  // Of x = speed^2: stiffnesses (c - a) x - p and (c - b) x - p; the middle coefficient b1 x + b0; and where
  // the discriminant d2 x^2 + d1 x + d0 changes its sign.
  const double b1 = (c - a) * (c - b) + a * b, b0 = -(a + b) * p;
  const double d2 = b1 * b1 - 4 * a * b * (c - a) * (c - b);
  const double d1 = 2 * b1 * b0 + 4 * a * b * p * (2 * c - a - b), d0 = (a - b) * (a - b) * p * p;
  constexpr double one = 1e-9;  // bounds as near as that are one: the moments of a mesh are no better
  std::vector<double> bounds = {0, p / (c - a), p / (c - b), -b0 / b1};
  const double root = std::sqrt(d1 * d1 - 4 * d2 * d0);
  const double far = -(d1 + std::copysign(root, d1)) / 2;  // without cancellation
  bounds.insert(bounds.end(), {far / d2, d0 / far, std::numeric_limits<double>::infinity()});
  std::erase_if(bounds, [](double x) { return !(x >= 0); });  // also what is not a number
  for (double& x : bounds) x += 0.0;                          // minus zero is zero
  std::ranges::sort(bounds);

  std::vector<SpeedRange> ranges;
  const RigidBody ideal{Eigen::Vector3d(a, b, c).asDiagonal(), Vec3(0, 0, p), 0};
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    const double low = bounds[i], high = bounds[i + 1];
    if (!(high > low * (1 + one))) continue;
    const double inside = std::isinf(high) ? (low > 0 ? 2 * low : 1) : (low + high) / 2;
    if (seen_from(ideal, Vec3::UnitZ(), std::sqrt(inside)).characteristic().growth() > 0) continue;
    if (!ranges.empty() && std::sqrt(low) <= ranges.back().high * (1 + one))
      ranges.back().high = std::sqrt(high);
    else
      ranges.push_back({std::sqrt(low), std::sqrt(high)});
  }
  return ranges;
}

std::optional<double> stable_above(const std::vector<SpeedRange>& ranges) {
  if (ranges.empty() || !std::isinf(ranges.back().high)) return std::nullopt;
  return ranges.back().low;
}

}  // namespace kreisel::core
