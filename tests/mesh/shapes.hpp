// shapes.hpp - small solids whose faults and topology are known.
#pragma once

#include <cmath>
#include <utility>

#include "body/test_meshes.hpp"

namespace kreisel::core {

inline TriangleMesh inverted(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Both, with vertices of their own.
inline TriangleMesh both(TriangleMesh mesh, const TriangleMesh& other) {
  const auto offset = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles)
    mesh.triangles.push_back({a + offset, b + offset, c + offset});
  return mesh;
}

/// Three vertices of its own for every triangle, as in STL.
inline TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const Triangle& t : mesh.triangles) {
    const auto n = std::uint32_t(result.vertices.size());
    for (const std::uint32_t v : t) result.vertices.push_back(mesh.vertices[v]);
    result.triangles.push_back({n, n + 1, n + 2});
  }
  return result;
}

/// An m x n grid of quadrangles, closed in both directions; `twisted` glues the second the other way round: a
/// Klein bottle, of which only the connectivity is right.
inline TriangleMesh torus(int m, int n, bool twisted = false) {
  TriangleMesh mesh;
  const double turn = 2 * 3.14159265358979323846;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = turn * i / m, v = turn * j / n, r = 3 + std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
    }
  const auto at = [&](int i, int j) {
    if (i == m && twisted) j = n - j;
    return std::uint32_t((i % m) * n + (j % n + n) % n);
  };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

}  // namespace kreisel::core
