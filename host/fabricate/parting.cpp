#include "fabricate/parting.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/moved.hpp"
#include "mesh/query/surface_rays.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

/// The casting on one line along the direction: where it begins and ends, and begins again.
using Line = std::vector<std::pair<double, double>>;

/// A casting seen along a direction, in the coordinates of that direction: heights.
struct Lines {
  std::vector<Line> lines;
  double area;         ///< of the plane that a line stands for
  double bottom, top;  ///< of the casting

  Lines(const TriangleMesh& casting, const SurfaceRays& rays, const Vec3& normal, int across);
  [[nodiscard]] double undercut(double height) const;
};

Line along(const SurfaceRays& rays, const Vec3& from, const Vec3& normal, double end) {
  Line line;
  int depth = 0;
  for (double least = 0; const auto hit = rays.first(from, normal, least, end);) {
    if (!hit->out && depth++ == 0) line.push_back({hit->distance, hit->distance});
    if (hit->out && --depth == 0 && !line.empty()) line.back().second = hit->distance;
    least = std::nextafter(static_cast<float>(hit->distance), INFINITY);
  }
  return line;
}

Lines::Lines(const TriangleMesh& casting, const SurfaceRays& rays, const Vec3& normal, int across) {
  const Eigen::Matrix3d turn = axis_to_z(normal);
  const Box box = bounding_box(moved(casting, turn));
  bottom = box.lo[2], top = box.hi[2];
  const double step = std::max(box.extent()[0], box.extent()[1]) / across, below = 0.1 * box.extent().norm();
  area = step * step;
  for (double y = box.lo[1] + step / 2; y < box.hi[1]; y += step)
    for (double x = box.lo[0] + step / 2; x < box.hi[0]; x += step) {
      const double start = bottom - below;
      Line line = along(rays, turn.transpose() * Vec3(x, y, start), normal, top - bottom + 2 * below);
      for (auto& [from, to] : line) from += start, to += start;
      if (!line.empty()) lines.push_back(std::move(line));
    }
}

/// Of each line what is between the height and the far ends of the casting without being casting.
double Lines::undercut(double height) const {
  double sum = 0;
  for (const Line& line : lines) {
    sum += std::max(0.0, line.back().second - height) + std::max(0.0, height - line.front().first);
    for (const auto& [from, to] : line) sum -= to - from;
  }
  return area * std::max(0.0, sum);
}

/// The axes, and directions of the upper half of the sphere.
std::vector<Vec3> directions() {
  std::vector<Vec3> all = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  constexpr int upper = 100;
  const std::vector<Vec3> sphere = sphere_directions(2 * upper);
  all.insert(all.end(), sphere.begin(), sphere.begin() + upper);
  return all;
}

/// Of heights with the same undercut that in the middle is the best: a height at the far end weighs as much
/// as half of this share of the casting's volume, which rays on a grid do not tell, anyway.
constexpr double unseen = 1e-3;

Parting best_height(const Lines& seen, const Vec3& normal) {
  constexpr int heights = 64;
  const double middle = (seen.bottom + seen.top) / 2, size = seen.top - seen.bottom;
  double volume = 0;
  for (const Line& line : seen.lines)
    for (const auto& [from, to] : line) volume += seen.area * (to - from);
  Parting best{{normal, middle}, INFINITY};
  double least = INFINITY;
  for (int k = 1; k < heights; ++k) {
    const double height = seen.bottom + size * k / heights, held = seen.undercut(height);
    const double cost = held + unseen * volume * std::abs(height - middle) / size;
    if (cost < least) best = {{normal, height}, held}, least = cost;
  }
  return best;
}

}  // namespace

Parting least_undercut(const TriangleMesh& casting) {
  const SurfaceRays rays(casting);
  const std::vector<Vec3> normals = directions();
  std::vector<Parting> partings(normals.size());
  parallel_for(normals.size(), [&](std::size_t k) {
    partings[k] = best_height(Lines(casting, rays, normals[k], 32), normals[k]);
  });
  const Vec3 normal = std::ranges::min_element(partings, {}, &Parting::undercut)->normal;
  return best_height(Lines(casting, rays, normal, 96), normal);
}

double undercut(const TriangleMesh& casting, const Vec3& normal, double offset, int across) {
  return Lines(casting, SurfaceRays(casting), normal.normalized(), across).undercut(offset);
}

}  // namespace kreisel::core
