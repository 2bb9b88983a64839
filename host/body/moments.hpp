// moments.hpp - the ten numbers that every part of the project exchanges.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "kreisel/moments.hpp"

namespace kreisel::core {

using kreisel::Matrix10;
using kreisel::Moments;
using enum kreisel::MomentIndex;

/// A sum with what its rounding errors are measured by: error bounds are relative to `abs_sum`.
struct MomentSums {
  Moments value = Moments::Zero();
  Moments abs_sum = Moments::Zero();  ///< sum of the absolute values of everything that is added up
};

/// In the order of MomentIndex.
inline constexpr std::array<std::string_view, 10> moment_names = {"s1",  "sx",  "sy",  "sz",  "sxy",
                                                                  "syz", "sxz", "sxx", "syy", "szz"};

/// Centre of mass. s1 must not be zero.
[[nodiscard]] Eigen::Vector3d centre_of_mass(const Moments& s);

/// The second moments as a symmetric matrix, integral of x x^T.
[[nodiscard]] Eigen::Matrix3d second_moments(const Moments& s);

/// Inertia tensor about the origin of the moments' frame. [SpinIt, eq. 4]
[[nodiscard]] Eigen::Matrix3d inertia(const Moments& s);

/// Inertia tensor about the centre of mass (parallel axis theorem).
[[nodiscard]] Eigen::Matrix3d inertia_about_centre(const Moments& s);

/// Principal axes of an inertia tensor.
struct PrincipalAxes {
  Eigen::Vector3d moments;  ///< ascending
  Eigen::Matrix3d axes;     ///< columns of unit length, in the order of the moments

  explicit PrincipalAxes(const Eigen::Matrix3d& inertia);
  [[nodiscard]] int nearest_to_z() const;     ///< which of the three
  [[nodiscard]] double tilt_degrees() const;  ///< of that one from z
};

/// Moments of the same solid after x -> R x + t (R any 3x3 matrix of determinant +-1).
[[nodiscard]] Moments transformed(const Moments& s, const Eigen::Matrix3d& R, const Eigen::Vector3d& t);

/// The same as a matrix: transformed(s, R, t) = moment_map(R, t) * s.
[[nodiscard]] Matrix10 moment_map(const Eigen::Matrix3d& R, const Eigen::Vector3d& t);

/// Moments of the same solid after x -> length * x with its density times `density`.
[[nodiscard]] Moments scaled(const Moments& s, double length, double density);

/// Moments of a box with the given centre and edge lengths at unit density (closed form).
[[nodiscard]] Moments box_moments(const Eigen::Vector3d& centre, const Eigen::Vector3d& edges);

}  // namespace kreisel::core
