#include "mesh/query/equal_vertices.hpp"

#include <algorithm>

#include "geometry/exact_point_hash.hpp"
#include "geometry/first_equal.hpp"

namespace kreisel::core {

std::vector<std::uint32_t> first_equal_vertex(const std::vector<Vec3>& vertices) {
  return first_equal(
      vertices.size(),
      [&](std::uint32_t i) {
        const Vec3& v = vertices[i];
        return ExactPointHash()({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0});  // -0 + 0 is 0
      },
      [&](std::uint32_t i, std::uint32_t j) { return vertices[i] == vertices[j]; });
}

std::size_t equal_vertex_count(const std::vector<Vec3>& vertices) {
  const std::vector<std::uint32_t> first = first_equal_vertex(vertices);
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < first.size(); ++v) count += first[v] != v;
  return count;
}

std::vector<std::uint32_t> first_equal_triangle(const std::vector<Triangle>& triangles) {
  const auto corners = [&](std::uint32_t i) {
    Triangle t = triangles[i];
    std::ranges::sort(t);
    return t;
  };
  return first_equal(
      triangles.size(),
      [&](std::uint32_t i) {
        std::uint64_t h = 0;
        for (const std::uint32_t v : corners(i)) {
          h = (h ^ v) * 0x9e3779b97f4a7c15ULL;
          h ^= h >> 32;
        }
        return h;
      },
      [&](std::uint32_t i, std::uint32_t j) { return corners(i) == corners(j); });
}

}  // namespace kreisel::core
