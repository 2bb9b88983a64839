#include "fabricate/wall.hpp"

#include <algorithm>
#include <atomic>
#include <limits>

#include "geometry/triangle.hpp"
#include "mesh/query/distance.hpp"
#include "parallel.hpp"

namespace kreisel::core {

namespace {

/// Of many points, by all threads.
class LeastDistance {
 public:
  /// @param most  of all distances there are
  LeastDistance(const TriangleMesh& outer, double most, double skin)
      : distance_(outer), most_(most), skin_(skin), least_(most) {}

  template <class Point>
  void look_at(std::size_t count, Point&& point) {
    parallel_for(count, 1024, [&](std::size_t i) { look_at(point(i)); });
  }
  [[nodiscard]] double result() const {
    const double least = least_;
    return least < most_ ? least : std::numeric_limits<double>::infinity();
  }

 private:
  void look_at(const Vec3& p) {
    // A search need go no further than the least so far.
    double so_far = least_.load(std::memory_order_relaxed);
    const double here = distance_(p, so_far);
    if (here <= skin_) return;
    while (here < so_far && !least_.compare_exchange_weak(so_far, here, std::memory_order_relaxed)) {
    }
  }

  SurfaceDistance distance_;
  double most_, skin_;
  std::atomic<double> least_;
};

double farthest_apart(const TriangleMesh& a, const TriangleMesh& b) {
  return 2 * (bounding_box(a).extent() + bounding_box(b).extent()).norm();
}

}  // namespace

double least_wall(const TriangleMesh& outer, const TriangleMesh& cavity) {
  if (cavity.triangles.empty()) return std::numeric_limits<double>::infinity();
  LeastDistance least(outer, farthest_apart(outer, cavity), -1);
  least.look_at(cavity.vertices.size(), [&](std::size_t i) { return cavity.vertices[i]; });
  least.look_at(cavity.triangles.size(),
                [&](std::size_t i) { return middle_of(cavity, cavity.triangles[i]); });
  return least.result();
}

double least_wall_within(const TriangleMesh& outer, const TriangleMesh& part, double skin) {
  LeastDistance least(outer, farthest_apart(outer, part), skin);
  least.look_at(part.vertices.size(), [&](std::size_t i) { return part.vertices[i]; });
  return least.result();
}

}  // namespace kreisel::core
