#include "deform/submerged.hpp"

#include <Eigen/Geometry>
#include <array>

#include "body/mesh_moments_gradient.hpp"
#include "geometry/triangle.hpp"

namespace kreisel::core {
namespace {

/// A point of a triangle by its barycentric coordinates.
using Place = Vec3;

/// Calls visit(three places) for triangles that make up what of one lies below the plane.
template <class Visit>
void below(const std::array<Vec3, 3>& corners, double surface, const Visit& visit) {
  std::array<Place, 4> polygon;
  std::size_t count = 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double here = corners[static_cast<std::size_t>(k)][2] - surface,
                 there = corners[static_cast<std::size_t>(next)][2] - surface;
    if (here <= 0) polygon[count++] = Place::Unit(k);
    if ((here <= 0) != (there <= 0)) {
      const double t = here / (here - there);
      polygon[count++] = (1 - t) * Place::Unit(k) + t * Place::Unit(next);
    }
  }
  for (std::size_t k = 2; k < count; ++k) visit(std::array{polygon[0], polygon[k - 1], polygon[k]});
}

Vec3 at(const std::array<Vec3, 3>& corners, const Place& place) {
  return place[0] * corners[0] + place[1] * corners[1] + place[2] * corners[2];
}

}  // namespace

Moments submerged(const TriangleMesh& mesh, double surface) {
  Moments sum = Moments::Zero();
  const Vec3 tip(0, 0, surface);
  for (const Triangle& t : mesh.triangles) {
    const auto corners = corners_of(mesh, t);
    below(corners, surface, [&](const std::array<Place, 3>& places) {
      const Vec3 a = at(corners, places[0]) - tip, b = at(corners, places[1]) - tip,
                 c = at(corners, places[2]) - tip;
      const double volume = a.dot(b.cross(c)) / 6;
      sum[S1] += volume;
      sum[SX] += volume * (a[0] + b[0] + c[0]) / 4;
      sum[SY] += volume * (a[1] + b[1] + c[1]) / 4;
    });
  }
  return sum;
}

std::vector<Vec3> submerged_gradient(const TriangleMesh& mesh, double surface, const Moments& q) {
  std::vector<Vec3> gradient(mesh.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const auto corners = corners_of(mesh, t);
    below(corners, surface, [&](const std::array<Place, 3>& places) {
      const std::array<Vec3, 3> piece = {at(corners, places[0]), at(corners, places[1]),
                                         at(corners, places[2])};
      const Vec3 area = normal_of(piece[0], piece[1], piece[2]) / 2;
      const std::array<double, 3> means = means_with_hats(q, piece);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t p = 0; p < 3; ++p)
          gradient[t[k]] += means[p] * places[p][static_cast<Eigen::Index>(k)] * area;
    });
  }
  return gradient;
}

}  // namespace kreisel::core
