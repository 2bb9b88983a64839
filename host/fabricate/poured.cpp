#include "fabricate/poured.hpp"

#include <algorithm>
#include <cmath>

#include "fabricate/lattice_points.hpp"
#include "mesh/make/march.hpp"
#include "mesh/query/surface_rays.hpp"

namespace kreisel::core {
namespace {

using Index = CubicLattice::Index;

bool inside(const Channel& c, const Vec3& p) {
  return p[2] > c.bottom[2] && p[2] < c.top && (p - c.bottom).head<2>().squaredNorm() < c.radius * c.radius;
}

/// Where p + t d leaves a channel that p is in, t > 0.
double exit(const Channel& c, const Vec3& p, const Vec3& d) {
  double first = INFINITY;
  if (d[2] != 0) first = ((d[2] > 0 ? c.top : c.bottom[2]) - p[2]) / d[2];
  const Eigen::Vector2d from = (p - c.bottom).head<2>(), along = d.head<2>();
  const double a = along.squaredNorm(), b = from.dot(along), rest = c.radius * c.radius - from.squaredNorm();
  if (a > 0) first = std::min(first, (std::sqrt(b * b + a * rest) - b) / a);
  return first;
}

void mark_channel(const Channel& channel, const CubicLattice& lattice, std::vector<std::uint8_t>& marks) {
  lattice.for_each([&](const Index& at) {
    if (inside(channel, lattice.point(at))) marks[lattice.id(at)] = 1;
  });
}

Box box_of(const TriangleMesh& casting, const std::vector<Channel>& channels) {
  Box box = bounding_box(casting);
  for (const Channel& c : channels) {
    const Vec3 reach(c.radius, c.radius, 0);
    box.add(c.bottom - reach);
    box.add(Vec3(c.bottom[0], c.bottom[1], c.top) + reach);
  }
  return box;
}

}  // namespace

TriangleMesh poured(const TriangleMesh& casting, const std::vector<Channel>& channels, double cell) {
  const CubicLattice lattice(box_of(casting, channels), cell);
  const SurfaceRays rays(casting);
  std::vector<std::uint8_t> marks(lattice.size());
  for_each_inside(casting, 0, lattice, [&](const Index& at) { marks[lattice.id(at)] = 1; });
  for (const Channel& channel : channels) mark_channel(channel, lattice, marks);

  // A vertex too near to a point of the lattice would make triangles that a file in single precision folds.
  constexpr double clear = 1e-3;
  return march(lattice, marks, [&](const Index& in, const Index& out) {
    const Vec3 p = lattice.point(in), d = lattice.point(out) - p;
    double last = 0, least = 0;
    while (const auto hit = rays.first(p, d, least, 1)) {
      least = std::nextafter(static_cast<float>(hit->distance), INFINITY);
      if (hit->out) last = hit->distance;
    }
    for (const Channel& channel : channels)
      if (inside(channel, p + last * d)) last = std::max(last, exit(channel, p + last * d, d) + last);
    return Vec3(p + std::clamp(last, clear, 1 - clear) * d);
  });
}

}  // namespace kreisel::core
