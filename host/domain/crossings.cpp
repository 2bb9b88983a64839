#include "domain/crossings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "error.hpp"
#include "geometry/triangle.hpp"

namespace kreisel::core {
namespace {

/// Side of the directed line a -> b on which (x + eps, y + eps^2) lies: +1 left, -1 right, 0 only if a == b
/// in xy. Both triangles at an edge evaluate it with the end points in the same order, so they always agree.
int side(const Vec3& from, const Vec3& to, double x, double y) {
  const bool swapped = to[0] < from[0] || (to[0] == from[0] && to[1] < from[1]);
  const Vec3& a = swapped ? to : from;
  const Vec3& b = swapped ? from : to;
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double value = dx * (y - a[1]) - dy * (x - a[0]);
  const int sign = value > 0 ? 1 : value < 0 ? -1 : dy > 0 ? -1 : dy < 0 ? 1 : dx > 0 ? 1 : dx < 0 ? -1 : 0;
  return swapped ? -sign : sign;
}

std::optional<Crossing> cross(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y) {
  const int s = side(a, b, x, y);
  if (s == 0 || side(b, c, x, y) != s || side(c, a, x, y) != s) return std::nullopt;
  const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
  const double det = ux * vy - uy * vx;
  const double px = x - a[0], py = y - a[1];
  const double beta = (px * vy - py * vx) / det, gamma = (ux * py - uy * px) / det;
  double z = a[2] + beta * (b[2] - a[2]) + gamma * (c[2] - a[2]);
  if (!std::isfinite(z)) z = (a[2] + b[2] + c[2]) / 3;  // a sliver seen edge-on
  z = std::clamp(z, std::min({a[2], b[2], c[2]}), std::max({a[2], b[2], c[2]}));
  return Crossing{z, s > 0 ? -1 : 1};  // counter-clockwise from above: the outside is above, the line leaves
}

int balance(const std::vector<Crossing>& column) {
  int sum = 0;
  for (const Crossing& c : column) sum += c.winding;
  return sum;
}

std::vector<Crossing> trace(const TriangleMesh& mesh, double x, double y) {
  std::vector<Crossing> column;
  for (const Triangle& t : mesh.triangles)
    if (const auto hit = cross(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], x, y))
      column.push_back(*hit);
  return column;
}

/// First and last cell centre within [lo, hi] along an axis, with a cell to spare on either side.
std::pair<int, int> centres_between(const Grid& grid, int axis, double lo, double hi) {
  const double first = std::floor((lo - grid.origin[axis]) / grid.h - 0.5);
  const double last = std::ceil((hi - grid.origin[axis]) / grid.h - 0.5);
  return {std::max(0, static_cast<int>(first)), std::min(grid.n[axis] - 1, static_cast<int>(last))};
}

}  // namespace

std::vector<std::vector<Crossing>> column_crossings(const TriangleMesh& mesh, const Grid& grid) {
  std::vector<std::vector<Crossing>> columns(static_cast<std::size_t>(grid.n[0]) * grid.n[1]);
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners_of(mesh, t);
    const auto [x0, x1] =
        centres_between(grid, 0, std::min({a[0], b[0], c[0]}), std::max({a[0], b[0], c[0]}));
    const auto [y0, y1] =
        centres_between(grid, 1, std::min({a[1], b[1], c[1]}), std::max({a[1], b[1], c[1]}));
    for (int iy = y0; iy <= y1; ++iy)
      for (int ix = x0; ix <= x1; ++ix)
        if (const auto hit = cross(a, b, c, grid.centre(0, ix), grid.centre(1, iy)))
          columns[ix + static_cast<std::size_t>(grid.n[0]) * iy].push_back(*hit);
  }
  for (int iy = 0; iy < grid.n[1]; ++iy)
    for (int ix = 0; ix < grid.n[0]; ++ix) {
      auto& column = columns[ix + static_cast<std::size_t>(grid.n[0]) * iy];
      for (int attempt = 1; balance(column) != 0; ++attempt) {
        const double aside = 1e-6 * attempt * grid.h;
        if (attempt > 8)
          throw InputError(
              fmt::format("the vertical line at x = {:.6g}, y = {:.6g} (body units) enters the mesh "
                          "and never leaves it; expected a closed mesh",
                          grid.centre(0, ix), grid.centre(1, iy)));
        column = trace(mesh, grid.centre(0, ix) + aside, grid.centre(1, iy) + 0.7 * aside);
      }
      std::sort(column.begin(), column.end(), [](const Crossing& l, const Crossing& r) { return l.z < r.z; });
    }
  return columns;
}

}  // namespace kreisel::core
