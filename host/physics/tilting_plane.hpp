// tilting_plane.hpp - at what angle a standing body topples when the ground is tilted.
#pragma once

#include <vector>

#include "body/support_polygon.hpp"
#include "kreisel/moments.hpp"

namespace kreisel::core {

/// One way to tilt the ground.
struct Toppling {
  double azimuth = 0;  ///< of the downhill direction, radians from x
  double angle = 0;    ///< of the ground at which the body topples, radians; 0: it falls on level ground
};

/// The ground is tilted slowly, in each of `directions` evenly spread ways, until what the centre of mass
/// would fall on is no longer the base: found by bisection of the angle, without the base's edges. Friction
/// holds the body.
/// @param ground  z of the base
[[nodiscard]] std::vector<Toppling> tilt_the_plane(const SupportPolygon& base, double ground,
                                                   const Vec3& centre_of_mass, int directions = 360);

/// The worst of them.
[[nodiscard]] Toppling worst(const std::vector<Toppling>& all);

}  // namespace kreisel::core
