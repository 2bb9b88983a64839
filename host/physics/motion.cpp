#include "physics/motion.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "physics/gauss_step.hpp"

namespace kreisel::core {
namespace {

using Packed = Eigen::Matrix<double, 10, 1>;

Packed pack(const BodyState& s) { return (Packed() << s.attitude, s.up, s.momentum).finished(); }

BodyState unpack(const Packed& y) { return {y.head<4>(), y.segment<3>(4), y.tail<3>()}; }

/// Nothing in the body's equations turns much faster than this: how fast it spins, and how fast gravity can
/// set it turning.
double fastest_rate(const RigidBody& body, const BodyState& start) {
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.inertia).eigenvalues()[0];
  return start.momentum.norm() / least / 2 + angular_velocity(body, start.up, start.momentum).norm() / 2 +
         std::sqrt(body.lever.norm() / least);
}

double attitude_error(const BodyState& s) {
  return (Eigen::Quaterniond(s.attitude).conjugate() * Vec3::UnitZ() - s.up).norm();
}

}  // namespace

Motion simulate(const RigidBody& body, const BodyState& start, const MotionOptions& options) {
  const auto field = [&](const Packed& y) { return pack(derivative(body, unpack(y))); };
  Packed y = pack(start);
  if (!y.allFinite() || !body.inertia.allFinite() || !(options.duration > 0) || options.samples < 1)
    throw InputError(
        fmt::format("simulation over {} units of time in {} samples; expected both > 0 and a body "
                    "and start that are finite",
                    options.duration, options.samples));
  constexpr double step_angle = 0.15;  // radians; docs/physics.md has the drift of several
  const double interval = options.duration / options.samples;
  const double wanted = std::ceil(interval * fastest_rate(body, start) / step_angle) + 1;
  constexpr double most_steps = 1e8;  // some minutes
  if (!(wanted * options.samples < most_steps))
    throw InputError(fmt::format(
        "simulation in {:.2g} steps; expected fewer than {:.0g}: a shorter time, or a slower spin",
        wanted * options.samples, most_steps));
  const auto substeps = static_cast<int>(wanted);
  const double h = interval / substeps;

  const double energy0 = energy(body, start), momentum0 = vertical_momentum(start);
  const double energy_scale = std::abs(energy0 - body.lever.dot(start.up)) + body.lever.norm();
  const double momentum_scale = start.momentum.norm();
  Motion motion;
  Eigen::Matrix<double, 10, 3> slopes = field(y).replicate<1, 3>();
  const auto note = [&](const BodyState& s) {
    motion.largest_tilt = std::max(motion.largest_tilt, tilt_of(s));
    motion.least_force = std::min(motion.least_force, body.per_mass > 0 ? ground_force(body, s) : 1.0);
    if (energy_scale > 0)
      motion.energy_drift = std::max(motion.energy_drift, std::abs(energy(body, s) - energy0) / energy_scale);
    if (momentum_scale > 0)
      motion.momentum_drift =
          std::max(motion.momentum_drift, std::abs(vertical_momentum(s) - momentum0) / momentum_scale);
    motion.attitude_drift = std::max(motion.attitude_drift, attitude_error(s));
  };
  const auto keep = [&](double time, const BodyState& s) {
    motion.times.push_back(time);
    motion.tilts.push_back(tilt_of(s));
    motion.states.push_back(s);
  };
  note(start);
  keep(0, start);
  for (int sample = 0; sample < options.samples; ++sample) {
    for (int k = 1; k <= substeps; ++k) {
      if (!gauss_step<10>(field, y, h, slopes))
        throw InputError(fmt::format(
            "the motion cannot be followed beyond {} units of time; expected a body with three moments > 0",
            sample * interval + k * h));
      ++motion.steps;
      const BodyState s = unpack(y);
      note(s);
      if (tilt_of(s) < options.fallen) continue;
      motion.fell_at = sample * interval + k * h;
      keep(*motion.fell_at, s);
      return motion;
    }
    keep((sample + 1) * interval, unpack(y));
    if (options.stop && options.stop()) break;
  }
  return motion;
}

}  // namespace kreisel::core
