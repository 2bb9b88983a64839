// test_meshes.hpp - small meshes made by hand, and random numbers with a fixed seed.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

using Random = std::mt19937_64;

inline double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

inline Vec3 random_vec(Random& random, double lo, double hi) {
  const double x = uniform(random, lo, hi), y = uniform(random, lo, hi), z = uniform(random, lo, hi);
  return {x, y, z};
}

inline Eigen::Matrix3d random_rotation(Random& random) {
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

/// Axis-aligned box, two triangles a face.
inline TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi) {
  TriangleMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.emplace_back(c & 1 ? hi[0] : lo[0], c & 2 ? hi[1] : lo[1], c & 4 ? hi[2] : lo[2]);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Tetrahedron, outward when (b - a) x (c - a) points towards d.
inline TriangleMesh tetrahedron_mesh(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// The letter C in the xz-plane, 3 x 3 with a gap [1,3] x [1,2], drawn along y from 0 to `depth`:
/// columns at x > 1 meet it twice.
inline TriangleMesh letter_c_mesh(double depth) {
  const double outline[8][2] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}};
  TriangleMesh mesh;
  for (const double y : {0.0, depth})
    for (const auto& p : outline) mesh.vertices.emplace_back(p[0], y, p[1]);
  const std::vector<Triangle> cap = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 7}, {7, 4, 5}, {7, 5, 6}};
  for (const Triangle& t : cap) {
    mesh.triangles.push_back(t);
    mesh.triangles.push_back({t[2] + 8, t[1] + 8, t[0] + 8});
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t j = (i + 1) % 8;
    mesh.triangles.push_back({i, i + 8, j + 8});
    mesh.triangles.push_back({i, j + 8, j});
  }
  return mesh;
}

/// Torus with its axis along y: it stands upright, and columns near its middle meet it twice.
inline TriangleMesh upright_torus_mesh(double major, double minor, int around, int across) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = major + minor * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), minor * std::sin(v), r * std::sin(u));
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i % around * across + j % across); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      mesh.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const Eigen::Matrix3d& rotation, const Vec3& shift) {
  for (Vec3& v : mesh.vertices) v = rotation * v + shift;
  return mesh;
}

/// Triangles that bound nothing, in [-1,1]^3 with both of its far corners among the vertices: the middle of
/// the box is exactly the origin. Moments are sums over triangles, so this is as good as a solid.
inline TriangleMesh triangle_soup(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh{{Vec3::Constant(-1), Vec3::Constant(1)}, {}};
  while (mesh.triangles.size() < count) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back(random_vec(random, -1, 1));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace kreisel::core
