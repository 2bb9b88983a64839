#include "fabricate/thickness.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "geometry/triangle.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/query/surface_rays.hpp"
#include "parallel.hpp"

namespace kreisel::core {

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
      const auto hit = rays.first(from, -into_void.normalized(), off, size);
      if (hit && hit->distance < thinnest[c].thickness) thinnest[c] = {hit->distance, from};
    }
  });
  return *std::ranges::min_element(thinnest, {}, &ThinPlace::thickness);
}

}  // namespace kreisel::core
