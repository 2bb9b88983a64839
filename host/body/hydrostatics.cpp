#include "body/hydrostatics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/moved.hpp"
#include "parallel.hpp"

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

  Section& operator+=(const Section& more) {
    area += more.area;
    x += more.x;
    y += more.y;
    xx += more.xx;
    yy += more.yy;
    xy += more.xy;
    return *this;
  }

  [[nodiscard]] Eigen::Matrix2d about_centroid() const {
    if (!(area > 0)) return Eigen::Matrix2d::Zero();
    const double c = xy - x * y / area;
    return Eigen::Matrix2d{{xx - x * x / area, c}, {c, yy - y * y / area}};
  }
};

struct Least {
  double moment = 0, axis = 0;
};
/// Of all axes through the centroid.
Least least_second_moment(const Eigen::Matrix2d& about_centroid) {
  const double a = about_centroid(0, 0), b = about_centroid(1, 1), c = about_centroid(0, 1);
  // About an axis at t it is (a + b) / 2 - (a - b) / 2 cos 2t - c sin 2t.
  return {std::max(0.0, (a + b) / 2 - std::hypot((a - b) / 2, c)), std::atan2(c, (a - b) / 2) / 2};
}

struct Submerged {
  double volume = 0, dry = 0;
  Vec3 first = Vec3::Zero();
  Section section;

  Submerged& operator+=(const Submerged& more) {
    volume += more.volume;
    dry += more.dry;
    first += more.first;
    section += more.section;
    return *this;
  }
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

/// @param origin  in the waterplane
Submerged submerged(const DrySpace& space, const Vec3& origin) {
  const TriangleMesh& mesh = space.mesh();
  const std::vector<char> dry = space.vertices(origin[2]);
  const auto below = [&](std::uint32_t v) { return mesh.vertices[v][2] <= origin[2]; };
  const auto keeps_out = [&](const Triangle& t) {
    if (dry.empty()) return false;
    for (const std::uint32_t v : t)
      if (below(v)) return dry[v] != 0;
    return false;
  };
  // In blocks, whose sums are added in their order: threads do not matter to the result.
  constexpr std::size_t block = 1 << 14;
  const std::size_t all = mesh.triangles.size();
  std::vector<Submerged> parts((all + block - 1) / block);
  parallel_for(parts.size(), [&](std::size_t b) {
    Submerged within;
    for (std::size_t i = b * block; i < std::min((b + 1) * block, all); ++i) {
      const Triangle& t = mesh.triangles[i];
      if (std::ranges::none_of(t, below)) continue;
      add_clipped({mesh.vertices[t[0]] - origin, mesh.vertices[t[1]] - origin, mesh.vertices[t[2]] - origin},
                  keeps_out(t) ? within : parts[b]);
    }
    parts[b].dry = -within.volume;  // its surface faces into it
  });
  Submerged sum;
  for (const Submerged& part : parts) sum += part;
  return sum;
}

/// A point of the waterplane near the mesh, to keep cancellation small.
Vec3 origin_at(const Box& box, double waterline) {
  return {(box.lo[0] + box.hi[0]) / 2, (box.lo[1] + box.hi[1]) / 2, waterline};
}

/// From a waterline at which the mesh displaces less to one at which it displaces `volume` or more, the
/// lowest such that a look at a few levels tells; nothing where it nowhere does.
/// @param most  becomes the most seen on the way
std::optional<std::array<double, 2>> rise_to(const DrySpace& space, const Box& box, double volume,
                                             double* most = nullptr) {
  constexpr int levels = 12, halvings = 40;
  const auto displaced = [&](double z) { return submerged(space, origin_at(box, z)).volume; };
  const double low = box.lo[2], height = box.extent()[2];
  double z = low, at_z = 0, seen = 0;
  for (int level = 1; level <= levels; ++level) {
    double next = low + height * level / levels;
    double at_next = displaced(next);
    // What is less than before has been flooded in between: the most is reached right below that.
    if (at_next < at_z)
      for (double dry = z, wet = next, halving = 0; halving < halvings; ++halving) {
        const double middle = (dry + wet) / 2, there = displaced(middle);
        if (there < at_z) {
          wet = middle;
          continue;
        }
        dry = middle;
        seen = std::max(seen, there);
        if (there >= volume) return {{z, middle}};
        z = middle;
        at_z = there;
      }
    seen = std::max(seen, at_next);
    if (most) *most = seen;
    if (at_next >= volume) return {{z, next}};
    z = next;
    at_z = at_next;
  }
  // To round-off all of it is under water.
  constexpr double nearly = 1 - 1e-12;
  if (at_z >= volume * nearly) return {{box.hi[2], box.hi[2]}};
  if (seen >= volume * nearly) return {{low, box.hi[2]}};
  return {};
}

}  // namespace

Hydrostatics hydrostatics(const TriangleMesh& mesh, double waterline, const LazyCavities& cavities) {
  const Vec3 origin = origin_at(bounding_box(mesh), waterline);
  const Submerged sum = submerged(DrySpace(mesh, cavities), origin);
  Hydrostatics result;
  result.waterline = waterline;
  result.volume = sum.volume;
  result.dry = sum.dry;
  result.centre_of_buoyancy = sum.volume > 0 ? Vec3(origin + sum.first / sum.volume) : origin;
  result.waterplane_area = sum.section.area;
  result.second_moments = sum.section.about_centroid();
  const Least least = least_second_moment(result.second_moments);
  result.least_second_moment = least.moment;
  result.least_axis = least.axis;
  return result;
}

std::optional<double> waterline_of(const TriangleMesh& mesh, double volume, const LazyCavities& cavities) {
  const Box box = bounding_box(mesh);
  const DrySpace space(mesh, cavities);
  const auto span = rise_to(space, box, volume);
  if (!span) return {};
  auto [low, high] = *span;
  double z = (low + high) / 2;
  // Of a level; and of a volume, which is a sum over up to millions of triangles.
  const double round_off = 1e-15 * box.extent()[2], of_the_sum = 1e-14 * volume;
  double before = std::numeric_limits<double>::infinity();
  // Newton's method, whose slope is the section's area; where it does not halve the error, or leaves what is
  // known to hold the waterline, a halving of that.
  for (int step = 0; step < 120; ++step) {
    const Submerged sum = submerged(space, origin_at(box, z));
    const double error = sum.volume - volume;
    (error < 0 ? low : high) = z;
    double next = z - error / sum.section.area;
    if (std::abs(next - z) <= round_off) return next;
    if (std::abs(error) <= of_the_sum) return z;
    if (!(next > low && next < high) || !(std::abs(error) < before / 2)) next = (low + high) / 2;
    if (high - low <= round_off) break;
    before = std::abs(error);
    z = next;
  }
  return z;
}

double most_displaced(const TriangleMesh& mesh) {
  double most = 0;
  (void)rise_to(DrySpace(mesh), bounding_box(mesh), std::numeric_limits<double>::infinity(), &most);
  return most;
}

std::optional<double> flooding_heel(const TriangleMesh& mesh, double volume, double azimuth) {
  constexpr double quarter = std::numbers::pi / 2, precise = 1e-3 * std::numbers::pi / 180;
  constexpr int steps = 18;
  const Vec3 along(std::cos(azimuth), std::sin(azimuth), 0);
  const auto is_dry = [&](double heel) {
    const TriangleMesh heeled = moved(mesh, Eigen::AngleAxisd(heel, along).toRotationMatrix());
    const auto waterline = waterline_of(heeled, volume);
    return waterline && hydrostatics(heeled, *waterline).dry > 0;
  };
  std::optional<double> least;
  for (const double way : {1.0, -1.0})
    for (int step = 1; step <= steps; ++step) {
      double low = quarter * (step - 1) / steps, high = quarter * step / steps;
      if (least && low >= *least) break;
      if (is_dry(way * high)) continue;
      while (high - low > precise) (is_dry(way * (low + high) / 2) ? low : high) = (low + high) / 2;
      least = std::min(high, least.value_or(high));
      break;
    }
  return least;
}

}  // namespace kreisel::core
