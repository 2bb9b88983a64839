#include "mesh/io/polygons.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/clip_ears.hpp"
#include "geometry/flip_delaunay.hpp"
#include "geometry/predicates.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

using Corners = std::span<const std::uint32_t>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Normal of the best plane, of twice the area that the outline has when it is seen along it [Newell].
Vec3 normal_of(const std::vector<Vec3>& vertices, Corners face) {
  Vec3 sum = Vec3::Zero();
  const Vec3& origin = vertices[face[0]];
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    sum += (vertices[face[k]] - origin).cross(vertices[face[k + 1]] - origin);
  return sum;
}

/// The corners without the axis that the plane is least along, counter-clockwise: coordinates stay exact, so
/// that what lies on a straight line does so here.
std::vector<Vec2> dropped(const std::vector<Vec3>& vertices, Corners face, const Vec3& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  std::vector<Vec2> points;
  for (const std::uint32_t v : face) {
    points.push_back(drop(vertices[v], axis));
    if (normal[axis] < 0) std::swap(points.back()[0], points.back()[1]);
  }
  return points;
}

/// The corners on the plane itself: a face that is far from plane may cross itself along an axis and not
/// here.
std::vector<Vec2> projected(const std::vector<Vec3>& vertices, Corners face, const Vec3& normal) {
  const Vec3 z = normal.normalized(), x = z.unitOrthogonal(), y = z.cross(x);
  std::vector<Vec2> points;
  for (const std::uint32_t v : face) {
    const Vec3 p = vertices[v] - vertices[face[0]];
    points.push_back({p.dot(x), p.dot(y)});
  }
  return points;
}

/// Has the polygon a corner to the left at every point, by more than round-off, and is it once around? A fan
/// about a straight side would have triangles without area.
bool clearly_convex(const std::vector<Vec2>& points) {
  constexpr double least_sine = 1e-9;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = points[i], &b = points[(i + 1) % n], &c = points[(i + 2) % n];
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1];
    if (!(ux * vy - uy * vx > least_sine * std::hypot(ux, uy) * std::hypot(vx, vy))) return false;
  }
  for (std::size_t i = 1; i + 1 < n; ++i)
    if (orient2d(points[0], points[i], points[i + 1]) <= 0) return false;
  return true;
}

Triangles fan(std::size_t corners) {
  Triangles triangles;
  for (std::uint32_t k = 2; k < corners; ++k) triangles.push_back({0, k - 1, k});
  return triangles;
}

/// Triangles of places in the face; nothing where it crosses itself.
std::optional<Triangles> fill(const std::vector<Vec3>& vertices, Corners face) {
  const Vec3 normal = normal_of(vertices, face);
  if (!(normal.squaredNorm() > 0) || !normal.allFinite()) return std::nullopt;
  const std::vector<Vec2> exact = dropped(vertices, face, normal);
  if (clearly_convex(exact)) return fan(face.size());
  std::vector<std::uint32_t> outline(face.size());
  for (std::uint32_t k = 0; k < outline.size(); ++k) outline[k] = k;
  for (const auto& points : {exact, projected(vertices, face, normal)})
    if (auto triangles = clip_ears(points, outline)) {
      flip_to_delaunay(points, *triangles);
      return triangles;
    }
  return std::nullopt;
}

}  // namespace

MeshReading triangulated(PolygonMesh polygons) {
  MeshReading reading;
  std::size_t fans = 0;
  for (std::size_t f = 0; f < polygons.faces(); ++f) {
    stop_here();
    const Corners face = polygons.face(f);
    if (face.size() == 3) {
      reading.mesh.triangles.push_back({face[0], face[1], face[2]});
      continue;
    }
    auto triangles = fill(polygons.vertices, face);
    if (!triangles) {
      triangles = fan(face.size());
      ++fans;
    }
    for (const auto& [a, b, c] : *triangles) reading.mesh.triangles.push_back({face[a], face[b], face[c]});
  }
  if (fans)
    reading.notes.push_back(
        fans == 1
            ? "cut 1 face that crosses itself or has no area into a fan about its first corner"
            : fmt::format(
                  "cut {} faces that cross themselves or have no area into fans about their first corners",
                  fans));
  reading.mesh.vertices = std::move(polygons.vertices);
  return reading;
}

}  // namespace kreisel::core
