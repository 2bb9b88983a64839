#include "problem/ray_direction.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "problem/balance.hpp"

namespace kreisel::core {

std::optional<Vec3> rays_of_balance(const Settings& settings, const Body& body) {
  const auto made = make_balance(settings, body);
  const auto& balance = dynamic_cast<const Balance&>(*made);
  const Moments& s = body.solid;
  const Vec3 c = centre_of_mass(s);
  const Eigen::Matrix3d sigma = second_moments(s) / s[S1] - c * c.transpose();
  Eigen::Matrix<double, 3, Eigen::Dynamic> across = Eigen::Matrix3d::Identity();
  if (const auto& line = balance.direction()) across = axes_along(*line).topRows<2>().transpose().eval();
  const Eigen::VectorXd off = across.transpose() * (balance.point() - c);
  if (off.norm() < 1e-9) return std::nullopt;  // body lengths
  const Vec3 normal = (across * (across.transpose() * sigma * across).ldlt().solve(off)).normalized(),
             in_model = body.frame.rotation.transpose() * normal;
  Eigen::Index axis = 0;
  const double squarest = in_model.cwiseAbs().maxCoeff(&axis);
  if (std::abs(normal.z()) >= std::min(squarest, 1 / std::numbers::sqrt3)) return std::nullopt;
  return Vec3::Unit(axis);
}

}  // namespace kreisel::core
