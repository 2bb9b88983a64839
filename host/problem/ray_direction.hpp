// ray_direction.hpp - which way the rays of a domain had best run.
#pragma once

#include <optional>

#include "problem/problem.hpp"

namespace kreisel::core {

/// The model's axis along which rays meet the cut of `balance` most squarely: it leaves their direction open,
/// and what it asks tells where the cut will be. Rays along a plane are all its or none of it; as it moves,
/// their moments jump. [docs/quadric.md, s. 3]
///
/// A fill that falls off linearly, 1 + a . (x - c), moves the centre of mass c by Sigma a, Sigma the second
/// moments about c over the mass. So the material that moves it to p lies along a = Sigma^-1 (p - c), to
/// first order, and on a line only what is across it counts.
///
/// @return  model coordinates; nothing where there is nothing to move, or where the body's own axis is within
///          54.7 degrees of a, as one of three axes always is
[[nodiscard]] std::optional<Vec3> rays_of_balance(const Settings& settings, const Body& body);

}  // namespace kreisel::core
