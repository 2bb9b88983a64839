// units.hpp - speeds between body units and revolutions per minute.
#pragma once

#include <cmath>
#include <numbers>

namespace kreisel::core {

/// Lengths in L, masses in the solid's own and gravity 1: the unit of time is sqrt(L / g).
[[nodiscard]] inline double seconds_per_unit(double length_mm) {
  constexpr double gravity = 9806.65;  // mm/s^2
  return std::sqrt(length_mm / gravity);
}

/// Revolutions per minute of a speed of 1 (radians per unit of time).
[[nodiscard]] inline double rpm_per_unit(double length_mm) {
  return 30 / std::numbers::pi / seconds_per_unit(length_mm);
}

[[nodiscard]] inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }
[[nodiscard]] inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace kreisel::core
