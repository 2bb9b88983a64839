// quadric.hpp - solid where one quadric is negative. [docs/quadric.md]
#pragma once

#include "domain/exact.hpp"
#include "formulation/formulation.hpp"
#include "formulation/quadric_moments.hpp"

namespace kreisel::core {

/// The vertical intervals that a domain consists of.
[[nodiscard]] Rays rays_of(const Columns& domain);
[[nodiscard]] Rays rays_of(const ExactColumns& domain);

/// x = the ten coefficients of q = x . (1 x y z xy yz xz xx yy zz) in the body frame; the interior is solid
/// where q < 0, and its moments depend on the direction of x alone. An optimum of any problem of the ten
/// moments has this form [Hafner, Ly, Wojtan 2024]. Offers its support oracle; curvature() is not diagonal
/// and not offered. Rounds to the voxels whose centre has q < 0. No settings.
std::unique_ptr<Formulation> make_quadric(const Columns& domain, const Traits& traits, const Settings&,
                                          device::Device& device);

/// The same over any intervals. They have no voxels: round() is not offered, see
/// fabricate/quadric_cavity.hpp.
std::unique_ptr<Formulation> make_quadric(const Rays& rays, device::Device& device);

}  // namespace kreisel::core
