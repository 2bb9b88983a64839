#include "mesh/solid/winding.hpp"

#include <algorithm>
#include <deque>

#include "error.hpp"
#include "geometry/predicates.hpp"
#include "geometry/triangle.hpp"
#include "mesh/solid/ray_winding.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

/// A face of each patch to look from, the largest.
struct View {
  std::uint32_t face = ~0u;
  double area = -1;
};

/// Is the point, which lies in the plane of the face and on none of its edges, in it?
bool holds(const Arrangement& all, std::uint32_t face, int axis, const ExactPoint& p) {
  int left = 0;
  for (std::size_t k = 0; k < 3; ++k)
    left += orient2d(all.points[all.faces[face][k]], all.points[all.faces[face][(k + 1) % 3]], p, axis);
  return std::abs(left) == 3;
}

/// Rays of many directions, in the order in which they are tried. None is along what people build.
std::deque<ParallelRays> all_rays(const TriangleMesh& mesh) {
  std::deque<ParallelRays> rays;
  for (const Vec3& d : {Vec3(113, 271, 977), Vec3(-641, 89, 353), Vec3(307, -811, -173)})
    rays.emplace_back(mesh, d);
  return rays;
}

class Looker {
 public:
  Looker(const TriangleMesh& mesh, const Arrangement& all) : mesh_(mesh), all_(all), rays_(all_rays(mesh)) {}

  /// What lies on both sides of the face's patch. @param middle  of the face
  [[nodiscard]] PatchSides look(std::uint32_t face, const ExactPoint& middle) const {
    const std::uint32_t own = all_.source[face];
    for (const ParallelRays& rays : rays_) {
      const auto seen = rays.count(middle);
      if (!seen) continue;
      const auto along = [&](std::uint32_t t) {
        return passes_forward(mesh_.triangles[t], rays.direction(), middle);
      };
      const int forward = along(own);
      int step = 0;  // from front to back: this face's, and that of others on it
      PatchSides sides;
      for (const std::uint32_t t : seen->here) {
        const int same = along(t) * forward;
        step += same;
        if (same > 0 && t != own) sides.repeated = sides.repeated || patch_at(t, middle) < all_.patch[face];
      }
      sides.front = forward > 0 ? seen->ahead : seen->ahead - step;
      sides.back = sides.front + step;
      return sides;
    }
    throw InputError(
        "the surface has a place from where no ray misses all edges; expected fewer thin triangles");
  }

 private:
  /// 1 when the direction leaves through the triangle's front, -1 when through its back.
  [[nodiscard]] int passes_forward(const Triangle& t, const Vec3& direction, const ExactPoint& p) const {
    return passes(p, direction, mesh_.vertices[t[0]], mesh_.vertices[t[1]]);
  }

  [[nodiscard]] std::uint32_t patch_at(std::uint32_t triangle, const ExactPoint& p) const {
    const auto [a, b, c] = corners_of(mesh_, mesh_.triangles[triangle]);
    const int axis = projection_axis(a, b, c);
    const auto [first, last] = std::equal_range(all_.source.begin(), all_.source.end(), triangle);
    for (auto i = first; i != last; ++i)
      if (const auto face = std::uint32_t(i - all_.source.begin()); holds(all_, face, axis, p))
        return all_.patch[face];
    return ~0u;
  }

  const TriangleMesh& mesh_;
  const Arrangement& all_;
  std::deque<ParallelRays> rays_;
};

}  // namespace

std::vector<PatchSides> winding(const TriangleMesh& mesh, const Arrangement& all) {
  std::vector<View> views(all.faces.size());  // by patch
  for (std::uint32_t f = 0; f < all.faces.size(); ++f) {
    const auto& [a, b, c] = all.faces[f];
    const double area = normal_of(all.points.near(a), all.points.near(b), all.points.near(c)).norm();
    if (View& view = views[all.patch[f]]; area > view.area) view = {f, area};
  }
  std::erase_if(views, [](const View& view) { return view.area < 0; });
  std::vector<ExactPoint> middles;  // made by one thread: points become exact when they are asked for
  for (const View& view : views) {
    stop_here();
    const auto& [a, b, c] = all.faces[view.face];
    middles.push_back(middle_of(all.points[a], all.points[b], all.points[c]));
  }
  const Looker looker(mesh, all);
  std::vector<PatchSides> sides(all.faces.size());
  parallel_for(views.size(), 64, [&](std::size_t i) {
    sides[all.patch[views[i].face]] = looker.look(views[i].face, middles[i]);
  });
  for (std::uint32_t f = 0; f < sides.size(); ++f) sides[f] = sides[all.patch[f]];
  return sides;
}

}  // namespace kreisel::core
