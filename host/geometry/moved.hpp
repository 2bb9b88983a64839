// moved.hpp - a mesh somewhere else, or the other way round; and parts of it.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <utility>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Every vertex through the map: a matrix, an affine map, or whatever takes a vector by `*`.
template <class Map>
[[nodiscard]] TriangleMesh moved(TriangleMesh mesh, const Map& map) {
  for (Vec3& v : mesh.vertices) v = map * v;
  return mesh;
}

/// The same triangles seen from their other side.
[[nodiscard]] inline TriangleMesh turned_over(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Some triangles, by their numbers, and the vertices they use, in the order of their use.
[[nodiscard]] inline TriangleMesh part_of(const TriangleMesh& mesh,
                                          std::span<const std::uint32_t> triangles) {
  constexpr std::uint32_t none = ~0u;
  TriangleMesh part;
  std::vector<std::uint32_t> number(mesh.vertices.size(), none);
  for (const std::uint32_t t : triangles)
    for (std::uint32_t& v : part.triangles.emplace_back(mesh.triangles[t])) {
      if (number[v] == none) {
        number[v] = static_cast<std::uint32_t>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[v]);
      }
      v = number[v];
    }
  return part;
}

}  // namespace kreisel::core
