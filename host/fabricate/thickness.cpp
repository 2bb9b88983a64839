#include "fabricate/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/triangle.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/query/surface_rays.hpp"
#include "parallel.hpp"

namespace kreisel::core {

namespace {

/// How far along a ray of length 1 the plane of a triangle lies, in double; nothing for a ray within it.
std::optional<double> distance_to_plane(const TriangleMesh& mesh, const Triangle& t, const Vec3& from,
                                        const Vec3& direction) {
  const Vec3 normal = normal_of(mesh, t);
  const double along = normal.dot(direction);
  if (!(std::abs(along) > 1e-6 * normal.norm())) return std::nullopt;
  return normal.dot(mesh.vertices[t[0]] - from) / along;
}

}  // namespace

ThinPlace thinnest_material(const TriangleMesh& outer, const TriangleMesh& cavity) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (cavity.triangles.empty()) return {infinity};
  const TriangleMesh part = joined({outer, cavity}, "part");
  const SurfaceRays rays(part);
  const double size = bounding_box(outer).extent().norm(),
               off = 1e-5 * size;  // the surface that a ray begins on
  constexpr std::size_t chunk = 1024;
  std::vector<ThinPlace> thinnest((cavity.triangles.size() + chunk - 1) / chunk, ThinPlace{infinity});
  parallel_for(thinnest.size(), [&](std::size_t c) {
    for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, cavity.triangles.size()); ++i) {
      const Vec3 into_void = normal_of(cavity, cavity.triangles[i]);
      if (!(into_void.norm() > 0)) continue;
      const Vec3 from = middle_of(cavity, cavity.triangles[i]);
      const Vec3 direction = -into_void.normalized();
      const auto hit = rays.first(from, direction, off, size);
      if (!hit) continue;
      // Single precision finds the triangle; how far it is, is asked of the triangle itself.
      const double distance = std::clamp(
          distance_to_plane(part, part.triangles[hit->triangle], from, direction).value_or(hit->distance),
          hit->distance - off, hit->distance + off);
      if (distance < thinnest[c].thickness) thinnest[c] = {distance, from};
    }
  });
  return *std::ranges::min_element(thinnest, {}, &ThinPlace::thickness);
}

}  // namespace kreisel::core
