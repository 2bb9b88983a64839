// test_bodies.hpp - bodies with wanted mass, height of the centre of mass and moments of inertia.
#pragma once

#include <random>

#include "body/moments.hpp"
#include "physics/rigid_body.hpp"

namespace kreisel::core {

/// @param inertia  about the centre of mass
inline Moments moments_of(double mass, const Vec3& centre, const Eigen::Matrix3d& inertia) {
  const Eigen::Matrix3d q = inertia.trace() / 2 * Eigen::Matrix3d::Identity() - inertia;
  Moments s;
  s << mass, 0, 0, 0, q(0, 1), q(1, 2), q(0, 2), q(0, 0), q(1, 1), q(2, 2);
  return transformed(s, Eigen::Matrix3d::Identity(), centre);
}

inline Moments moments_of(double mass, double height, const Vec3& principal) {
  return moments_of(mass, Vec3(0, 0, height), principal.asDiagonal());
}

/// Some rigid body: the sums of any two principal moments exceed the third.
inline Vec3 random_principal(std::mt19937& random) {
  std::uniform_real_distribution<double> size(0.02, 0.2);
  const Vec3 second(size(random), size(random), size(random));
  return Vec3::Constant(second.sum()) - second;
}

}  // namespace kreisel::core
