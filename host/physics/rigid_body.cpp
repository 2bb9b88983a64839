#include "physics/rigid_body.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace kreisel::core {

RigidBody make_rigid_body(const Moments& s, Contact contact) {
  const Vec3 lever = s.segment<3>(SX);
  if (contact == Contact::held) return {inertia(s), lever, 0};
  if (contact == Contact::free) return {inertia_about_centre(s), Vec3::Zero(), 0};
  return {inertia_about_centre(s), lever, 1 / s[S1]};
}

namespace {

/// At rest.
BodyState tilted(double tilt) {
  BodyState state;
  // The vertical leans from body z towards the middle of x and y.
  const Vec3 about = Vec3(-1, 1, 0).normalized();
  state.attitude = Eigen::Quaterniond(Eigen::AngleAxisd(-tilt, about)).coeffs();
  state.up = Eigen::AngleAxisd(tilt, about) * Vec3::UnitZ();
  return state;
}

}  // namespace

BodyState tilted_start(const RigidBody& body, double spin, double tilt) {
  BodyState state = tilted(tilt);
  const Vec3 w = spin * Vec3::UnitZ(), a = body.lever.cross(state.up);
  state.momentum = body.inertia * w + body.per_mass * a.dot(w) * a;
  return state;
}

BodyState free_start(const RigidBody& body, double spin, double tilt) {
  BodyState state = tilted(tilt);
  state.momentum = spin * body.inertia(2, 2) * state.up;
  return state;
}

Vec3 angular_velocity(const RigidBody& body, const Vec3& up, const Vec3& momentum) {
  const Vec3 a = body.lever.cross(up);
  return (body.inertia + body.per_mass * a * a.transpose()).inverse() * momentum;
}

BodyState derivative(const RigidBody& body, const BodyState& state) {
  const Vec3& u = state.up;
  const Vec3 w = angular_velocity(body, u, state.momentum);
  BodyState rate;
  const Eigen::Quaterniond q(state.attitude);
  rate.attitude = 0.5 * (q * Eigen::Quaterniond(0, w[0], w[1], w[2])).coeffs();
  rate.up = u.cross(w);
  const Vec3 slope = body.lever - body.per_mass * body.lever.cross(u).dot(w) * w.cross(body.lever);  // dH/du
  rate.momentum = state.momentum.cross(w) + u.cross(slope);
  return rate;
}

double energy(const RigidBody& body, const BodyState& state) {
  return 0.5 * state.momentum.dot(angular_velocity(body, state.up, state.momentum)) +
         body.lever.dot(state.up);
}

double ground_force(const RigidBody& body, const BodyState& state) {
  const Vec3 &u = state.up, w = angular_velocity(body, u, state.momentum), a = body.lever.cross(u);
  // Newton and Euler: I w' = I w x w - (1 + z'') a, with z' = a . w / M.
  const double swing = body.per_mass * body.lever.cross(u.cross(w)).dot(w);
  const Vec3 torque = (body.inertia * w).cross(w) - (1 + swing) * a;
  const Vec3 turning = (body.inertia + body.per_mass * a * a.transpose()).inverse() * torque;
  return 1 + swing + body.per_mass * a.dot(turning);
}

double tilt_of(const BodyState& state) { return std::atan2(state.up.head<2>().norm(), state.up[2]); }

}  // namespace kreisel::core
