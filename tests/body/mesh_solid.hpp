// mesh_solid.hpp - volume, centre and inertia of what a mesh bounds, by tetrahedra.
#pragma once

#include <Eigen/Geometry>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Mass, centre and inertia about the centre of the solid inside a mesh at unit density.
struct Solid {
  double volume = 0;
  Vec3 centre = Vec3::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

inline Solid solid_of(const TriangleMesh& mesh) {
  Solid s;
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const double det = a.dot(b.cross(c));
    const Vec3 sum = a + b + c;
    s.volume += det / 6;
    first += det / 24 * sum;
    second += det / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  s.centre = first / s.volume;
  second -= s.volume * s.centre * s.centre.transpose();
  s.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return s;
}

}  // namespace kreisel::core
