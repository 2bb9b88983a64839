#include "physics/righting_arm.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "body/hydrostatics.hpp"
#include "error.hpp"
#include "parallel.hpp"

namespace kreisel::core {

double righting_arm_at(const Afloat& afloat, double azimuth, double heel) {
  const Vec3 along(std::cos(azimuth), std::sin(azimuth), 0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(heel, along).toRotationMatrix();
  TriangleMesh turned = afloat.mesh;
  for (Vec3& v : turned.vertices) v = turn * (v - afloat.centre_of_mass);
  const auto waterline = waterline_of(turned, afloat.volume);
  if (!waterline) return std::numeric_limits<double>::quiet_NaN();
  const Hydrostatics water = hydrostatics(turned, *waterline);
  // Lifted at r from the centre of mass the body gets the torque r x z; against a heel about `along`, that is
  // -along . (r x z).
  return -along.dot(water.centre_of_buoyancy.cross(Vec3::UnitZ()));
}

RightingArm righting_arm(const Afloat& afloat, double azimuth, int steps) {
  const double all = most_displaced(afloat.mesh);
  if (!(afloat.volume > 0 && afloat.volume < all) || steps < 2)
    throw InputError(
        fmt::format("righting arm with {:.4g} displaced, in {} steps; expected less than the {:.4g} of "
                    "the body submerged, above 0, and two steps or more",
                    afloat.volume, steps, all));
  const auto count = static_cast<std::size_t>(steps) + 1;
  RightingArm arm;
  arm.azimuth = azimuth;
  for (std::size_t i = 0; i < count; ++i)
    arm.heel.push_back(std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps));
  arm.gz.resize(count);
  parallel_for(count, [&](std::size_t i) { arm.gz[i] = righting_arm_at(afloat, azimuth, arm.heel[i]); });
  constexpr double small = 1e-4;  // facets bend GZ at no smaller scale
  arm.metacentric_height =
      (righting_arm_at(afloat, azimuth, small) - righting_arm_at(afloat, azimuth, -small)) / (2 * small);
  if (!(arm.metacentric_height > 0)) return arm;
  for (std::size_t i = 1; i + 2 < count; ++i) {           // at the last it is level again, upside down
    if (!(arm.gz[i] > 0) || arm.gz[i + 1] > 0) continue;  // it falls, or goes under
    double low = arm.heel[i], high = arm.heel[i + 1];
    for (int halving = 0; halving < 10; ++halving) {
      const double middle = (low + high) / 2;
      (righting_arm_at(afloat, azimuth, middle) > 0 ? low : high) = middle;
    }
    arm.vanishing = (low + high) / 2;
    break;
  }
  return arm;
}

}  // namespace kreisel::core
