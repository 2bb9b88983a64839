// bodies.hpp - bodies for the tests of deformation.
#pragma once

#include <cmath>
#include <numbers>

#include "body/source.hpp"
#include "body/test_meshes.hpp"

namespace kreisel::core {

/// An ellipsoid about the origin as a mesh of circles of latitude, turned about the y-axis: it stays its own
/// mirror image in y.
inline TriangleMesh leaning_ellipsoid(const Vec3& half_axes, double degrees, std::uint32_t around) {
  const std::uint32_t across = around / 2;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitY()).toRotationMatrix();
  TriangleMesh mesh;
  mesh.vertices.push_back(turn * Vec3(0, 0, half_axes[2]));
  for (std::uint32_t i = 1; i < across; ++i)
    for (std::uint32_t j = 0; j < around; ++j) {
      const double t = std::numbers::pi * i / across, p = 2 * std::numbers::pi * j / around;
      const Vec3 unit(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
      mesh.vertices.push_back(turn * unit.cwiseProduct(half_axes));
    }
  mesh.vertices.push_back(turn * Vec3(0, 0, -half_axes[2]));
  const std::uint32_t last = static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * around + j % around; };
  for (std::uint32_t j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < across; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(across - 1, j), last, at(across - 1, j + 1)});
  }
  return mesh;
}

inline Source source_of(TriangleMesh mesh) {
  Source source;
  source.name = "made";
  source.mesh = std::move(mesh);
  source.ours = true;
  return source;
}

}  // namespace kreisel::core
