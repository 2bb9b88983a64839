#include "nest/search/keep_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.hpp"

namespace kreisel::core::nest {

KeepOuts::KeepOuts(const Nesting& nesting, const std::vector<KeepOut>& balls)
    : KeepOuts(nesting, balls, nesting.outer()) {}

KeepOuts::KeepOuts(const Nesting& nesting, const std::vector<KeepOut>& balls, const TriangleMesh& mesh) {
  for (const KeepOut& ball : balls) {
    const Vec3 centre = nesting.to_file(ball.centre);
    const double radius = ball.radius * nesting.unit();
    if (!(radius > 0) || !std::isfinite(radius))
      throw InputError(fmt::format("keep-out of radius {}; expected a number > 0", radius));
    std::vector<Vec3> surface;
    for (const Triangle& triangle : mesh.triangles)
      if (std::ranges::any_of(triangle, [&](std::uint32_t v) {
            return (mesh.vertices[v] - ball.centre).norm() <= ball.radius;
          }))
        for (const std::uint32_t v : triangle) surface.push_back(mesh.vertices[v]);
    if (surface.empty())
      throw InputError(fmt::format(
          "keep-out at {} of radius {}: no vertex of the outer shape lies in it; expected one at least",
          fmt::join(centre, ","), radius));
    surfaces_.push_back(std::move(surface));
  }
}

bool KeepOuts::touched(const Cut& cut) const {
  return std::ranges::any_of(surfaces_, [&](const std::vector<Vec3>& surface) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Vec3& v : surface) {
      const double beyond = cut.above(v);
      least = std::min(least, beyond);
      most = std::max(most, beyond);
    }
    return least <= 0 && most >= 0;
  });
}

}  // namespace kreisel::core::nest
