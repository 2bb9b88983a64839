// rotation.hpp - directions, and rotations that go with them.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The rotation with the smallest angle that takes `axis` (any length but zero) to +z.
[[nodiscard]] Eigen::Matrix3d axis_to_z(const Vec3& axis);

/// Rows: two unit vectors across the direction and the direction itself; right-handed.
/// @param direction  of length 1
[[nodiscard]] Eigen::Matrix3d axes_along(const Vec3& direction);

/// What uniform numbers in [0, 1) make uniform on the sphere.
[[nodiscard]] Vec3 uniform_direction(double u, double v);

/// What uniform numbers in [0, 1) make uniform over all rotations. [Shoemake 1992, Uniform random rotations,
/// Graphics Gems III]
[[nodiscard]] Eigen::Quaterniond uniform_rotation(double u, double v, double w);

/// n directions, one for about each 4 pi / n of the sphere: equal steps along z, from above, golden angles
/// around it. [Fibonacci lattice] @throws InputError  n < 1
[[nodiscard]] std::vector<Vec3> sphere_directions(int n);

}  // namespace kreisel::core
