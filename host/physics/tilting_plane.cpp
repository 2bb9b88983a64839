#include "physics/tilting_plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kreisel::core {

std::vector<Toppling> tilt_the_plane(const SupportPolygon& base, double ground, const Vec3& centre_of_mass,
                                     int directions) {
  std::vector<Toppling> all;
  for (int i = 0; i < directions; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / directions;
    const Vec2 downhill(std::cos(azimuth), std::sin(azimuth));
    const auto stands = [&](double angle) {
      const double height = centre_of_mass[2] - ground;
      return base.inside(centre_of_mass.head<2>() + height * std::tan(angle) * downhill) >= 0;
    };
    double low = 0, high = std::numbers::pi / 2;
    if (stands(0))
      for (int halving = 0; halving < 52; ++halving) {
        const double middle = (low + high) / 2;
        (stands(middle) ? low : high) = middle;
      }
    all.push_back({azimuth, low});
  }
  return all;
}

Toppling worst(const std::vector<Toppling>& all) {
  return *std::ranges::min_element(all, {}, &Toppling::angle);
}

}  // namespace kreisel::core
