// geodesic.hpp - an evenly divided sphere, the parameter domain of the smooth models.
#pragma once

#include <functional>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Unit sphere: each face of an icosahedron cut into n^2 triangles and pushed out to the sphere (class I
/// geodesic). 10 n^2 + 2 shared vertices, 20 n^2 triangles, closed, outward.
/// @param frequency  n >= 1
/// @throws InputError  n < 1, or so large that the counts leave 32 bits
[[nodiscard]] TriangleMesh geodesic_sphere(int frequency);

/// The geodesic sphere with every vertex u moved to surface(u). Outward and closed as long as `surface` is a
/// star-shaped surface seen from some point inside, or an affine image of the sphere that keeps its
/// handedness.
[[nodiscard]] TriangleMesh wrap_geodesic(int frequency, const std::function<Vec3(const Vec3&)>& surface);

}  // namespace kreisel::core
