// quadric_value.hpp - the quadric that ten coefficients stand for, at a point.
#pragma once

#include "body/moments.hpp"

namespace kreisel::core {

/// q . (1 x y z xy yz xz xx yy zz).
[[nodiscard]] inline double quadric_value(const Moments& q, const Eigen::Vector3d& x) {
  return q[S1] + (q[SX] + q[SXX] * x[0] + q[SXY] * x[1] + q[SXZ] * x[2]) * x[0] +
         (q[SY] + q[SYY] * x[1] + q[SYZ] * x[2]) * x[1] + (q[SZ] + q[SZZ] * x[2]) * x[2];
}

}  // namespace kreisel::core
