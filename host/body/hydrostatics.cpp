#include "body/hydrostatics.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

namespace kreisel::core {
namespace {

/// Integrals over the section's area of 1, x, y, x^2, y^2, xy, summed along its boundary.
struct Section {
  double area = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

  /// One directed piece of the boundary, the section to its left. [Green's theorem]
  void add(const Vec3& p, const Vec3& q) {
    const double c = p[0] * q[1] - q[0] * p[1];
    area += c / 2;
    x += c * (p[0] + q[0]) / 6;
    y += c * (p[1] + q[1]) / 6;
    xx += c * (p[0] * p[0] + p[0] * q[0] + q[0] * q[0]) / 12;
    yy += c * (p[1] * p[1] + p[1] * q[1] + q[1] * q[1]) / 12;
    xy += c * (p[0] * q[1] + 2 * p[0] * p[1] + 2 * q[0] * q[1] + q[0] * p[1]) / 24;
  }

  struct Least {
    double moment = 0, axis = 0;
  };
  /// Of all axes through the centroid.
  [[nodiscard]] Least least_second_moment() const {
    if (!(area > 0)) return {};
    const double a = xx - x * x / area, b = yy - y * y / area, c = xy - x * y / area;
    // About an axis at t it is (a + b) / 2 - (a - b) / 2 cos 2t - c sin 2t.
    return {std::max(0.0, (a + b) / 2 - std::hypot((a - b) / 2, c)), std::atan2(c, (a - b) / 2) / 2};
  }
};

struct Submerged {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Section section;
};

/// The part of a triangle at z <= 0 as a fan of tetrahedra to the origin, which lies in the waterplane: so
/// the section itself adds no volume.
void add_clipped(const std::array<Vec3, 3>& corner, Submerged& sum) {
  std::array<Vec3, 4> below;
  int count = 0;
  Vec3 leaves = Vec3::Zero(), enters = Vec3::Zero();
  bool crosses = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = corner[k], &b = corner[(k + 1) % 3];
    if (a[2] <= 0) below[count++] = a;
    if ((a[2] <= 0) == (b[2] <= 0)) continue;
    // From the lower end, so that both triangles of an edge find the same point.
    const Vec3 &low = a[2] <= 0 ? a : b, &high = a[2] <= 0 ? b : a;
    Vec3 cut = low + low[2] / (low[2] - high[2]) * (high - low);
    cut[2] = 0;
    below[count++] = cut;
    (a[2] <= 0 ? leaves : enters) = cut;
    crosses = true;
  }
  for (int k = 2; k < count; ++k) {
    const double volume = below[0].dot(below[k - 1].cross(below[k])) / 6;
    sum.volume += volume;
    sum.first += volume / 4 * (below[0] + below[k - 1] + below[k]);
  }
  // The surface runs along the plane from where it leaves to where it enters; the section beside it the other
  // way.
  if (crosses) sum.section.add(enters, leaves);
}

Submerged submerged(const TriangleMesh& mesh, const Vec3& origin) {
  Submerged sum;
  for (const Triangle& t : mesh.triangles)
    add_clipped({mesh.vertices[t[0]] - origin, mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin},
                sum);
  return sum;
}

/// A point of the waterplane near the mesh, to keep cancellation small.
Vec3 origin_at(const Box& box, double waterline) {
  return {(box.lo[0] + box.hi[0]) / 2, (box.lo[1] + box.hi[1]) / 2, waterline};
}

}  // namespace

Hydrostatics hydrostatics(const TriangleMesh& mesh, double waterline) {
  const Vec3 origin = origin_at(bounding_box(mesh), waterline);
  const Submerged sum = submerged(mesh, origin);
  Hydrostatics result;
  result.waterline = waterline;
  result.volume = sum.volume;
  result.centre_of_buoyancy = sum.volume > 0 ? Vec3(origin + sum.first / sum.volume) : origin;
  result.waterplane_area = sum.section.area;
  const Section::Least least = sum.section.least_second_moment();
  result.least_second_moment = least.moment;
  result.least_axis = least.axis;
  return result;
}

double waterline_of(const TriangleMesh& mesh, double volume) {
  const Box box = bounding_box(mesh);
  double low = box.lo[2], high = box.hi[2], z = (low + high) / 2;
  const double round_off = 1e-15 * box.extent()[2];
  double before = std::numeric_limits<double>::infinity();
  // Newton's method, whose slope is the section's area; where it does not halve the error, or leaves what is
  // known to hold the waterline, a halving of that.
  for (int step = 0; step < 120; ++step) {
    const Submerged sum = submerged(mesh, origin_at(box, z));
    const double error = sum.volume - volume;
    (error < 0 ? low : high) = z;
    double next = z - error / sum.section.area;
    if (std::abs(next - z) <= round_off) return next;
    if (!(next > low && next < high) || !(std::abs(error) < before / 2)) next = (low + high) / 2;
    if (high - low <= round_off) break;
    before = std::abs(error);
    z = next;
  }
  return z;
}

}  // namespace kreisel::core
