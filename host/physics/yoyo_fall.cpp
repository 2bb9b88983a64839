#include "physics/yoyo_fall.hpp"

#include <fmt/format.h>

#include <cmath>

#include "error.hpp"

namespace kreisel::core {
namespace {

/// Inertia about the axle in units of that of the mass at the string.
double ratio(const Moments& s, double radius) {
  if (!(radius > 0) || !std::isfinite(radius))
    throw InputError(fmt::format("an axle of radius {} L; expected > 0", radius));
  return inertia_about_centre(s)(2, 2) / (s[S1] * radius * radius);
}

}  // namespace

YoyoFall yoyo_fall(const Moments& s, double radius) {
  const double k = ratio(s, radius);
  return {1 / (1 + k), k / (1 + k), 1 / (1 + k) / radius};
}

double speed_after(const Moments& s, double radius, double height) {
  return std::sqrt(2 * height / (1 + ratio(s, radius))) / radius;
}

}  // namespace kreisel::core
