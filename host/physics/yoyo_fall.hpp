// yoyo_fall.hpp - a yo-yo that runs down its string.
#pragma once

#include "body/moments.hpp"

namespace kreisel::core {

/// In the plane of the string, which stays vertical and unwinds from the axle without slipping.
struct YoyoFall {
  double acceleration = 0;  ///< of the centre of mass, in g
  double tension = 0;       ///< of the string, in weights
  double turning = 0;       ///< angular acceleration, in g / L
};

/// M a = M - F, I a / r = F r.
/// @param s  about the axle's centre, z along the axle
/// @param radius  of the axle, > 0; body units
/// @throws InputError  a radius that is not
[[nodiscard]] YoyoFall yoyo_fall(const Moments& s, double radius);

/// Speed after a fall by `height` from rest, radians per unit of time: M h = M v^2 / 2 + I w^2 / 2, v = r w.
[[nodiscard]] double speed_after(const Moments& s, double radius, double height);

}  // namespace kreisel::core
