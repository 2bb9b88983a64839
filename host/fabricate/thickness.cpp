#include "fabricate/thickness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "geometry/triangle.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/query/surface_rays.hpp"
#include "parallel.hpp"

namespace kreisel::core {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether `other` is the other side of what t bounds.
bool face_each_other(const TriangleMesh& part, const Triangle& t, const Triangle& other) {
  if (std::ranges::find_first_of(t, other) != t.end()) return false;
  const Vec3 n = normal_of(part, t), m = normal_of(part, other);
  return -n.dot(m) >= std::cos(wall_opening * std::numbers::pi / 180) * n.norm() * m.norm();
}

/// The way to the side that faces triangle `i`; infinite where none does.
double thickness_at(const TriangleMesh& part, const SurfaceRays& rays, const Triangle& t, double size) {
  const Vec3 into_void = normal_of(part, t);
  if (!(into_void.norm() > 0)) return infinity;
  const Vec3 from = middle_of(part, t), direction = -into_void.normalized();
  const double off = 1e-5 * size;  // the surface that a ray begins on
  const auto hit = rays.first(from, direction, off, size);
  if (!hit || !face_each_other(part, t, part.triangles[hit->triangle])) return infinity;
  // Single precision finds the triangle; how far it is, is asked of the triangle itself.
  const Triangle& side = part.triangles[hit->triangle];
  const Vec3 normal = normal_of(part, side);
  return std::clamp(normal.dot(part.vertices[side[0]] - from) / normal.dot(direction), hit->distance - off,
                    hit->distance + off);
}

/// Triangles that touch one another, by their corners.
class Places {
 public:
  explicit Places(std::size_t corners) : of_(corners), area_(corners), first_(corners, none) {
    std::iota(of_.begin(), of_.end(), 0U);
  }

  /// Adds a triangle, and returns its place. @param rank  more than that of any before it
  std::uint32_t add(std::uint32_t rank, const Triangle& t, double area) {
    const std::uint32_t place = root(t[0]);
    for (const std::uint32_t other : {root(t[1]), root(t[2])}) {
      if (other == place || of_[other] != other) continue;
      of_[other] = place;
      area_[place] += area_[other];
      first_[place] = std::min(first_[place], first_[other]);
    }
    area_[place] += area;
    first_[place] = std::min(first_[place], rank);
    return place;
  }
  [[nodiscard]] double area(std::uint32_t place) const { return area_[place]; }
  [[nodiscard]] std::uint32_t first(std::uint32_t place) const { return first_[place]; }  ///< rank in it

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t root(std::uint32_t corner) {
    while (of_[corner] != corner) corner = of_[corner] = of_[of_[corner]];
    return corner;
  }

  std::vector<std::uint32_t> of_;
  std::vector<double> area_;
  std::vector<std::uint32_t> first_;
};

}  // namespace

ThinPlace thinnest_material(const TriangleMesh& outer, const TriangleMesh& cavity, double extent) {
  if (cavity.triangles.empty()) return {infinity};
  const TriangleMesh part = joined({cavity, outer}, "part");
  const SurfaceRays rays(part);
  const double size = bounding_box(outer).extent().norm();
  std::vector<double> thickness(cavity.triangles.size());
  constexpr std::size_t chunk = 1024;
  parallel_for((thickness.size() + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, thickness.size()); ++i)
      thickness[i] = thickness_at(part, rays, cavity.triangles[i], size);
  });

  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < thickness.size(); ++i)
    if (std::isfinite(thickness[i])) order.push_back(i);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return thickness[i]; });
  Places places(cavity.vertices.size());
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
    const Triangle& t = cavity.triangles[order[rank]];
    const std::uint32_t place = places.add(rank, t, normal_of(cavity, t).norm() / 2);
    if (places.area(place) >= extent * extent)
      return {thickness[order[rank]], middle_of(cavity, cavity.triangles[order[places.first(place)]])};
  }
  return {infinity};
}

}  // namespace kreisel::core
