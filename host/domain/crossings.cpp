#include "domain/crossings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
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

int balance(std::span<const Crossing> column) {
  int sum = 0;
  for (const Crossing& c : column) sum += c.winding;
  return sum;
}

std::vector<Crossing> trace(const TriangleMesh& mesh, double x, double y) {
  std::vector<Crossing> column;
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners_of(mesh, t);
    if (const auto hit = cross(a, b, c, x, y)) column.push_back(*hit);
  }
  return column;
}

/// The crossings of a column that round-off left unbalanced, from beside it.
std::vector<Crossing> trace_aside(const TriangleMesh& mesh, const Grid& grid, int ix, int iy) {
  const double x = grid.centre(0, ix), y = grid.centre(1, iy);
  for (int attempt = 1; attempt <= 8; ++attempt) {
    const double aside = 1e-6 * attempt * grid.h;
    std::vector<Crossing> column = trace(mesh, x + aside, y + 0.7 * aside);
    if (balance(column) == 0) return column;
  }
  throw InputError(
      fmt::format("the vertical line at x = {:.6g}, y = {:.6g} (body units) enters the mesh "
                  "and never leaves it; expected a closed mesh",
                  x, y));
}

void sort(std::span<Crossing> column) {
  std::sort(column.begin(), column.end(), [](const Crossing& l, const Crossing& r) {
    return l.z != r.z ? l.z < r.z : l.winding > r.winding;
  });
}

/// Centres of cells along an axis, counted from the first.
class Centres {
 public:
  Centres(const Grid& grid, int axis)
      : from_(grid.centre(axis, 0)), per_h_(1 / grid.h), last_(grid.n[axis] - 1) {}

  /// First and last within [lo, hi], with what round-off may do to their places to spare.
  [[nodiscard]] std::pair<int, int> between(double lo, double hi) const {
    constexpr double spare = 1e-6;
    const double first = std::max((lo - from_) * per_h_ - spare, 0.0), last = (hi - from_) * per_h_ + spare;
    if (last < 0 || first > last_) return {0, -1};
    const int whole = static_cast<int>(first);
    return {whole + (whole < first), static_cast<int>(std::min(last, double(last_)))};
  }

 private:
  double from_, per_h_;
  int last_;
};

struct Hit {
  std::uint32_t column;
  std::int32_t winding;
  double z;
};

/// In the order of the triangles.
std::vector<Hit> hits_of(const TriangleMesh& mesh, const Grid& grid) {
  const Centres along_x(grid, 0), along_y(grid, 1);
  std::vector<Hit> hits;
  for (const Triangle& t : mesh.triangles) {
    const auto [a, b, c] = corners_of(mesh, t);
    const auto [x0, x1] = along_x.between(std::min({a[0], b[0], c[0]}), std::max({a[0], b[0], c[0]}));
    if (x0 > x1) continue;
    const auto [y0, y1] = along_y.between(std::min({a[1], b[1], c[1]}), std::max({a[1], b[1], c[1]}));
    for (int iy = y0; iy <= y1; ++iy)
      for (int ix = x0; ix <= x1; ++ix)
        if (const auto hit = cross(a, b, c, grid.centre(0, ix), grid.centre(1, iy)))
          hits.push_back({static_cast<std::uint32_t>(ix + grid.n[0] * iy), hit->winding, hit->z});
  }
  return hits;
}

}  // namespace

ColumnCrossings column_crossings(const TriangleMesh& mesh, const Grid& grid) {
  const std::size_t columns = static_cast<std::size_t>(grid.n[0]) * grid.n[1];
  ColumnCrossings result;
  std::vector<std::uint32_t>& first = result.first_;
  first.assign(columns + 1, 0);
  {
    const std::vector<Hit> hits = hits_of(mesh, grid);
    for (const Hit& hit : hits) ++first[hit.column];
    std::uint32_t end = 0;
    for (std::uint32_t& at : first) at = end += at;  // of each column, and filled backwards from there
    result.all_.resize(hits.size());
    for (auto hit = hits.rbegin(); hit != hits.rend(); ++hit)
      result.all_[--first[hit->column]] = {hit->z, hit->winding};
  }
  std::map<std::size_t, std::vector<Crossing>> anew;
  for (std::size_t k = 0; k < columns; ++k) {
    if (balance(result[k]) != 0)
      anew[k] = trace_aside(mesh, grid, static_cast<int>(k) % grid.n[0], static_cast<int>(k) / grid.n[0]);
  }
  if (!anew.empty()) {
    ColumnCrossings other;
    other.first_.push_back(0);
    for (std::size_t k = 0; k < columns; ++k) {
      const auto found = anew.find(k);
      const std::span<const Crossing> column =
          found == anew.end() ? result[k] : std::span<const Crossing>(found->second);
      other.all_.insert(other.all_.end(), column.begin(), column.end());
      other.first_.push_back(static_cast<std::uint32_t>(other.all_.size()));
    }
    result = std::move(other);
  }
  for (std::size_t k = 0; k < columns; ++k)
    sort({result.all_.data() + result.first_[k], result.all_.data() + result.first_[k + 1]});
  return result;
}

}  // namespace kreisel::core
