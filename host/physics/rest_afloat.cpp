#include "physics/rest_afloat.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "body/hydrostatics.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

/// Turned so that z points up; the centre of mass is the origin.
struct Position {
  Hydrostatics water;
  [[nodiscard]] double energy() const { return -water.centre_of_buoyancy[2]; }

  /// With respect to small turns about x and y: the water shifts as the centre of buoyancy follows it, which
  /// costs nothing itself, for that is where the water has its least energy.
  [[nodiscard]] Eigen::Vector2d slope() const {
    return {-water.centre_of_buoyancy[1], water.centre_of_buoyancy[0]};
  }
  /// Metacentric heights. [RayRep, eq. 4, about both axes]
  [[nodiscard]] Eigen::Matrix2d curvature() const {
    const Eigen::Matrix2d& j = water.second_moments;
    Eigen::Matrix2d h{{j(1, 1), -j(0, 1)}, {-j(0, 1), j(0, 0)}};
    h /= water.volume;
    h.diagonal().array() += water.centre_of_buoyancy[2];
    return h;
  }
};

std::optional<Position> position(const Afloat& afloat, const Eigen::Matrix3d& turn) {
  stop_here();
  TriangleMesh turned = afloat.mesh;
  for (Vec3& v : turned.vertices) v = turn * (v - afloat.centre_of_mass);
  const auto waterline = waterline_of(turned, afloat.volume);
  if (!waterline) return {};
  return Position{hydrostatics(turned, *waterline)};
}

/// Downhill: Newton's step where the energy curves upwards, else as if it did; and off a crest.
Eigen::Vector2d step_from(const Position& at, double size) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> curvature(at.curvature());
  const Eigen::Vector2d slope = curvature.eigenvectors().transpose() * at.slope();
  const double flat = 1e-6 * size, off_a_crest = std::numbers::pi / 180;
  Eigen::Vector2d step;
  for (int k = 0; k < 2; ++k) {
    const double bend = curvature.eigenvalues()[k];
    step[k] = -slope[k] / std::max(std::abs(bend), flat);
    if (bend < 0 && std::abs(step[k]) < off_a_crest) step[k] = slope[k] > 0 ? -off_a_crest : off_a_crest;
  }
  constexpr double longest = std::numbers::pi / 12;
  if (const double length = step.norm(); length > longest) step *= longest / length;
  return curvature.eigenvectors() * step;
}

}  // namespace

RestAfloat rest_afloat(const Afloat& afloat) {
  const double size = bounding_box(afloat.mesh).extent().norm(), precise = 1e-9 * size;
  RestAfloat rest;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  std::optional<Position> here = position(afloat, turn);
  const bool kept_dry = here && here->water.dry > 0;
  constexpr int most_steps = 200, halvings = 20;
  for (int count = 0; here && count < most_steps; ++count) {
    Eigen::Vector2d step = step_from(*here, size);
    const double wanted = here->slope().dot(step);
    bool lower = false;
    for (int halving = 0; halving < halvings && !lower; ++halving, step /= 2) {
      const double angle = step.norm();
      if (!(angle > 0)) break;
      const Vec3 axis(step[0] / angle, step[1] / angle, 0);
      const Eigen::Matrix3d there = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * turn;
      const std::optional<Position> next = position(afloat, there);
      if (!next) {
        rest.sinks = true;
        rest.up = there.row(2);
        return rest;
      }
      rest.floods = rest.floods || (kept_dry && next->water.dry == 0);
      // Once water has come aboard the energy is another: it goes on from there.
      lower = next->energy() < here->energy() || (rest.floods && here->water.dry > 0);
      if (lower) {
        turn = there;
        here = next;
      }
    }
    if (!lower || (std::abs(wanted) < precise && here->slope().norm() < precise)) break;
  }
  rest.sinks = !here;
  rest.up = turn.row(2).transpose();
  return rest;
}

}  // namespace kreisel::core
