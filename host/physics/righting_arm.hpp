// righting_arm.hpp - how a floating body resists being heeled, at any angle.
#pragma once

#include <optional>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// What floats.
struct Afloat {
  const TriangleMesh& mesh;  ///< the outer surface, upright; any unit
  Vec3 centre_of_mass = Vec3::Zero();
  double volume = 0;  ///< displaced: mass over the fluid's density; below the most it can displace
};

/// The righting arm GZ over the heel angle: how far the centre of buoyancy lies to the side of the centre of
/// mass that it lifts. The body turns about one horizontal axis of its own, without trimming about the other,
/// and keeps displacing the same volume.
struct RightingArm {
  double azimuth = 0;             ///< of the axis it turns about, radians from x
  std::vector<double> heel, gz;   ///< radians, the mesh's unit; the first heel is 0; NaN where it goes under
  double metacentric_height = 0;  ///< slope of GZ at 0, by differences
  /// Heel beyond which it no longer returns: where GZ first falls through 0 (to a thousandth of a step);
  /// nothing where it is not righted at first, or returns from any angle.
  std::optional<double> vanishing;
};

/// @param steps  equal steps up to pi, >= 2
/// @throws InputError  a volume that the mesh does not displace
[[nodiscard]] RightingArm righting_arm(const Afloat& afloat, double azimuth, int steps = 36);

/// GZ at one heel, turning right-handed about the axis; NaN where it goes under.
[[nodiscard]] double righting_arm_at(const Afloat& afloat, double azimuth, double heel);

}  // namespace kreisel::core
