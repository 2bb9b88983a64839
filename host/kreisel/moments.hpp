// moments.hpp - the ten numbers of a solid.
#pragma once

#include <Eigen/Core>

namespace kreisel {

using Vec3 = Eigen::Vector3d;

/// Ten integrals of a solid, s_t = rho * integral of t over the solid, of 1 x y z xy yz xz xx yy zz.
/// Units: density times length^3 (the first), length^4 (the next three), length^5. [SpinIt, eq. 4]
using Moments = Eigen::Matrix<double, 10, 1>;
using Matrix10 = Eigen::Matrix<double, 10, 10>;

/// Position of each moment in Moments; results, kernels and files keep this order.
enum MomentIndex : int { S1, SX, SY, SZ, SXY, SYZ, SXZ, SXX, SYY, SZZ };

}  // namespace kreisel
