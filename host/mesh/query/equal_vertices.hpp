// equal_vertices.hpp - vertices at exactly the same place, and triangles with the same corners.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// For every vertex the lowest index of those whose three coordinates equal its own; 0 and -0 are equal.
[[nodiscard]] std::vector<std::uint32_t> first_equal_vertex(const std::vector<Vec3>& vertices);

/// How many are at the place of an earlier one.
[[nodiscard]] std::size_t equal_vertex_count(const std::vector<Vec3>& vertices);

/// For every triangle the lowest index of those with the same three vertices, in whatever order.
[[nodiscard]] std::vector<std::uint32_t> first_equal_triangle(const std::vector<Triangle>& triangles);

}  // namespace kreisel::core
