#include "mesh/solid/close_holes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "error.hpp"
#include "geometry/fill_polygon.hpp"
#include "geometry/predicates.hpp"
#include "mesh/query/sides.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

using Rim = std::vector<std::uint32_t>;

/// The rims of all holes, as the triangles of a patch would run along them.
std::vector<Rim> rims(const TriangleMesh& mesh) {
  std::multimap<std::uint32_t, std::uint32_t> onward;
  for_each_edge(sorted_sides(mesh), [&](auto first, auto last) {
    if (last - first == 1)
      first->forward ? onward.emplace(first->high, first->low) : onward.emplace(first->low, first->high);
  });
  std::vector<Rim> found;
  while (!onward.empty()) {
    Rim path{onward.begin()->first};
    while (true) {
      const auto next = onward.find(path.back());
      if (next == onward.end()) break;  // triangles that run different ways: no rim
      const std::uint32_t to = next->second;
      onward.erase(next);
      const auto before = std::ranges::find(path, to);
      if (before == path.end()) {
        path.push_back(to);
        continue;
      }
      found.emplace_back(before, path.end());
      path.erase(before + 1, path.end());
      if (path.size() == 1) break;
    }
  }
  std::erase_if(found, [](const Rim& rim) { return rim.size() < 3; });
  return found;
}

double area_of(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a).norm() / 2; }

/// Least area, and among equals less long edges. Cubic in the number of points.
std::vector<Triangle> least_area(const TriangleMesh& mesh, const Rim& rim) {
  const std::size_t n = rim.size();
  const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[rim[i]]; };
  const auto weight = [&](std::size_t i, std::size_t k, std::size_t j) {
    if (projection_axis(at(i), at(k), at(j)) < 0) return std::numeric_limits<double>::infinity();
    const double edges =
        (at(i) - at(k)).squaredNorm() + (at(k) - at(j)).squaredNorm() + (at(j) - at(i)).squaredNorm();
    return area_of(at(i), at(k), at(j)) + 0.01 * edges;
  };
  std::vector<double> best(n * n, 0);
  std::vector<std::size_t> by(n * n, 0);
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t i = 0; i + span < n; ++i) {
      stop_here();
      const std::size_t j = i + span;
      best[i * n + j] = std::numeric_limits<double>::infinity();
      for (std::size_t k = i + 1; k < j; ++k)
        if (const double w = best[i * n + k] + best[k * n + j] + weight(i, k, j); w < best[i * n + j]) {
          best[i * n + j] = w;
          by[i * n + j] = k;
        }
    }
  if (!std::isfinite(best[n - 1])) return {};
  std::vector<Triangle> patch;
  std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const std::size_t k = by[i * n + j];
    patch.push_back({rim[i], rim[k], rim[j]});
    open.push_back({i, k});
    open.push_back({k, j});
  }
  return patch;
}

Vec3 middle_of_rim(const TriangleMesh& mesh, const Rim& rim) {
  Vec3 sum = Vec3::Zero();
  for (const std::uint32_t v : rim) sum += mesh.vertices[v];
  return sum / double(rim.size());
}

/// The triangles within the outline on the plane that fits it best; none where that crosses itself.
std::vector<Triangle> outline(const TriangleMesh& mesh, const Rim& rim) {
  const Vec3 middle = middle_of_rim(mesh, rim);
  Vec3 normal = Vec3::Zero();  // twice the area along each axis [Newell]
  for (std::size_t i = 0; i < rim.size(); ++i)
    normal += (mesh.vertices[rim[i]] - middle).cross(mesh.vertices[rim[(i + 1) % rim.size()]] - middle);
  if (!(normal.norm() > 0)) return {};
  const Vec3 u = normal.unitOrthogonal(), v = normal.normalized().cross(u);
  std::vector<Vec2> points;
  Loop loop;
  for (const std::uint32_t p : rim) {
    const Vec3 from = mesh.vertices[p] - middle;
    loop.push_back(std::uint32_t(points.size()));
    points.emplace_back(u.dot(from), v.dot(from));
  }
  try {
    std::vector<Triangle> patch;
    for (const auto& [a, b, c] : fill_polygon(points, {loop})) patch.push_back({rim[a], rim[b], rim[c]});
    return patch;
  } catch (const InputError&) {
    return {};
  }
}

std::vector<Triangle> fan(TriangleMesh& mesh, const Rim& rim) {
  const auto middle = std::uint32_t(mesh.vertices.size());
  mesh.vertices.push_back(middle_of_rim(mesh, rim));
  std::vector<Triangle> patch;
  for (std::size_t i = 0; i < rim.size(); ++i) patch.push_back({middle, rim[i], rim[(i + 1) % rim.size()]});
  return patch;
}

std::vector<Triangle> patch_of(TriangleMesh& mesh, const Rim& rim) {
  constexpr std::size_t short_rim = 300;  // a cubic number of steps, milliseconds
  std::vector<Triangle> patch;
  if (rim.size() <= short_rim) patch = least_area(mesh, rim);
  if (patch.empty()) patch = outline(mesh, rim);
  return patch.empty() ? fan(mesh, rim) : patch;
}

}  // namespace

ClosedHoles close_holes(TriangleMesh& mesh, double largest) {
  ClosedHoles closed;
  for (const Rim& rim : rims(mesh)) {
    Box box;
    for (const std::uint32_t v : rim) box.add(mesh.vertices[v]);
    const double across = box.extent().norm();
    if (!(across <= largest)) continue;
    const Vec3 middle = middle_of_rim(mesh, rim);
    double between = 0;
    for (const Triangle& t : patch_of(mesh, rim)) {
      const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      closed.area += area_of(a, b, c);
      between += (a - middle).dot((b - middle).cross(c - middle)) / 6;
      mesh.triangles.push_back(t);
    }
    closed.between += std::abs(between);
    closed.widest = std::max(closed.widest, across);
    ++closed.count;
  }
  return closed;
}

}  // namespace kreisel::core
