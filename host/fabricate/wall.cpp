#include "fabricate/wall.hpp"

#include <algorithm>
#include <atomic>
#include <limits>

#include "mesh/distance.hpp"
#include "parallel.hpp"

namespace kreisel {

double least_wall(const TriangleMesh& outer, const TriangleMesh& cavity) {
  if (cavity.triangles.empty()) return std::numeric_limits<double>::infinity();
  const SurfaceDistance distance(outer);
  // A search need go no further than the least so far.
  std::atomic<double> least = (bounding_box(outer).extent() + bounding_box(cavity).extent()).norm();
  const auto look_at = [&](const Vec3& p) {
    double so_far = least.load(std::memory_order_relaxed);
    const double here = distance(p, so_far);
    while (here < so_far && !least.compare_exchange_weak(so_far, here, std::memory_order_relaxed)) {
    }
  };
  constexpr std::size_t chunk = 1024;
  const auto for_each = [&](std::size_t count, const auto& visit) {
    parallel_for((count + chunk - 1) / chunk, [&](std::size_t c) {
      for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, count); ++i) visit(i);
    });
  };
  for_each(cavity.vertices.size(), [&](std::size_t i) { look_at(cavity.vertices[i]); });
  for_each(cavity.triangles.size(), [&](std::size_t i) {
    const Triangle& t = cavity.triangles[i];
    const Vec3 &a = cavity.vertices[t[0]], &b = cavity.vertices[t[1]], &c = cavity.vertices[t[2]];
    look_at((a + b + c) / 3);
  });
  return least;
}

}  // namespace kreisel
