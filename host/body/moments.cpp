#include "body/moments.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace kreisel::core {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Moments assemble(double mass, const Vector3d& first, const Matrix3d& q) {
  Moments s;
  s << mass, first, q(0, 1), q(1, 2), q(0, 2), q(0, 0), q(1, 1), q(2, 2);
  return s;
}

Matrix3d inertia_of(const Matrix3d& q) { return q.trace() * Matrix3d::Identity() - q; }

}  // namespace

Matrix3d second_moments(const Moments& s) {
  Matrix3d q;
  q << s[SXX], s[SXY], s[SXZ], s[SXY], s[SYY], s[SYZ], s[SXZ], s[SYZ], s[SZZ];
  return q;
}

Vector3d centre_of_mass(const Moments& s) { return s.segment<3>(SX) / s[S1]; }

Matrix3d inertia(const Moments& s) { return inertia_of(second_moments(s)); }

Matrix3d inertia_about_centre(const Moments& s) {
  const Vector3d first = s.segment<3>(SX);
  return inertia_of(second_moments(s) - first * first.transpose() / s[S1]);
}

PrincipalAxes::PrincipalAxes(const Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(inertia);
  moments = solver.eigenvalues();
  axes = solver.eigenvectors();
}

int PrincipalAxes::nearest_to_z() const {
  int nearest = 0;
  axes.row(2).cwiseAbs().maxCoeff(&nearest);
  return nearest;
}

double PrincipalAxes::tilt_degrees() const {
  const double sine = axes.col(nearest_to_z()).head<2>().norm();
  return std::asin(std::min(1.0, sine)) * 180 / std::numbers::pi;
}

Moments transformed(const Moments& s, const Matrix3d& R, const Vector3d& t) {
  const Vector3d turned = R * s.segment<3>(SX);
  Matrix3d q = R * second_moments(s) * R.transpose();
  q += turned * t.transpose() + t * turned.transpose() + s[S1] * t * t.transpose();
  return assemble(s[S1], turned + s[S1] * t, q);
}

Matrix10 moment_map(const Matrix3d& R, const Vector3d& t) {
  Matrix10 map;
  for (int k = 0; k < 10; ++k) map.col(k) = transformed(Moments::Unit(k), R, t);
  return map;
}

Moments scaled(const Moments& s, double length, double density) {
  const double l3 = density * length * length * length;
  Moments r = s * l3;
  r.segment<3>(SX) *= length;
  r.tail<6>() *= length * length;
  return r;
}

Moments box_moments(const Vector3d& centre, const Vector3d& edges) {
  const double volume = edges.prod();
  Matrix3d q = volume * centre * centre.transpose();
  q.diagonal() += volume / 12.0 * edges.cwiseAbs2();
  return assemble(volume, volume * centre, q);
}

}  // namespace kreisel::core
