#include "fabricate/quadric_cavity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>

#include "error.hpp"
#include "fabricate/lattice_points.hpp"
#include "geometry/distance.hpp"
#include "geometry/moved.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

using Index = CubicLattice::Index;

/// A lattice point counts as inside when it is this far in, in cells: then no vertex comes so near to it that
/// slivers collapse when a file rounds them to single precision.
constexpr double margin = 1e-3;

/// q as a constant, a vector and a symmetric matrix.
class Quadric {
 public:
  explicit Quadric(const Moments& q) : c_(q[S1]), b_(q[SX], q[SY], q[SZ]) {
    a_ << q[SXX], q[SXY] / 2, q[SXZ] / 2, q[SXY] / 2, q[SYY], q[SYZ] / 2, q[SXZ] / 2, q[SYZ] / 2, q[SZZ];
  }

  [[nodiscard]] double operator()(const Vec3& p) const { return c_ + b_.dot(p) + p.dot(a_ * p); }
  [[nodiscard]] Vec3 gradient(const Vec3& p) const { return b_ + 2 * a_ * p; }

  /// The p + t d nearest to p with q = 0; nothing when that line misses the quadric.
  [[nodiscard]] std::optional<Vec3> along(const Vec3& p, const Vec3& d) const {
    const double c = (*this)(p), half_b = gradient(p).dot(d) / 2, a = d.dot(a_ * d);
    const double square = half_b * half_b - a * c;
    if (square < 0) return std::nullopt;
    const double r = half_b > 0 ? half_b + std::sqrt(square) : half_b - std::sqrt(square);
    if (r == 0) return std::nullopt;
    return Vec3(p - c / r * d);  // the smaller root in size
  }

  /// The first t in (0, 1] where q(p + t d) falls below zero; 1 where it does not. q(p) >= 0.
  [[nodiscard]] double exit(const Vec3& p, const Vec3& d) const {
    const double c = (*this)(p), half_b = gradient(p).dot(d) / 2, a = d.dot(a_ * d);
    // a t^2 + 2 half_b t + c = 0; in the form that adds what has one sign
    const double square = half_b * half_b - a * c;
    if (square < 0) return 1;
    const double r = half_b > 0 ? half_b + std::sqrt(square) : half_b - std::sqrt(square);
    double first = 1;
    for (const double t : {-r / a, -c / r})
      if (t > 0 && t < first) first = t;
    return first;
  }

 private:
  double c_;
  Vec3 b_;
  Eigen::Matrix3d a_;
};

/// A t in [0, end) where f(t) is within `tolerance` of zero, or above it with the zero next to it.
/// f(0) > 0 > f(end). Regula falsi (Illinois), which kinks do not stop.
template <class Function>
double zero(const Function& f, double end, double tolerance) {
  double t0 = 0, t1 = end, f0 = f(t0), f1 = f(t1);
  for (int step = 0, kept = -1; step < 60; ++step) {
    const double t = step % 8 == 7 ? (t0 + t1) / 2 : t0 + (t1 - t0) * f0 / (f0 - f1);
    if (!(t > t0 && t < t1)) break;
    const double value = f(t);
    if (std::abs(value) <= tolerance) return t;
    // An end that stays twice weighs half as much from then on.
    if (value > 0) {
      t0 = t, f0 = value;
      if (kept == 1) f1 /= 2;
      kept = 1;
    } else {
      t1 = t, f1 = value;
      if (kept == 0) f0 /= 2;
      kept = 0;
    }
  }
  return t0;
}

/// The largest t <= end up to which p + t d stays `wall` away from the surface, within `tolerance`; p itself
/// is farther than that.
///
/// The points near a triangle are convex, so the segment enters them once: stepping back to where it enters
/// those of the triangle nearest to its end, until no triangle is too near, passes by none.
double stay_deep(const SurfaceDistance& distance, const TriangleMesh& mesh, const Vec3& p, const Vec3& d,
                 double end, double wall, double tolerance) {
  while (const auto near = distance.nearest(p + end * d, wall - tolerance)) {
    const auto corners = corners_of(mesh, mesh.triangles[*near]);
    const auto depth = [&](const Vec3& at) {
      return distance_to_triangle(at, corners[0], corners[1], corners[2]);
    };
    end = zero([&](double s) { return depth(p + s * d) - wall; }, end, tolerance / 2);
  }
  return end;
}

/// Where the quadric and the surface `wall` deep meet in the plane of a face: along the quadric, from a point
/// on it to where the depth is the wall.
std::optional<Vec3> meeting_point(const Quadric& quadric, const SurfaceDistance& distance,
                                  const std::array<Vec3, 3>& face, const Vec3& on_quadric,
                                  const Vec3& on_offset, double wall, double tolerance) {
  const Vec3 normal = normal_of(face[0], face[1], face[2]).normalized();
  Vec3 across = quadric.gradient(on_quadric);
  across -= normal.dot(across) * normal;
  const Vec3 along = on_offset - on_quadric;
  const auto at = [&](double t) { return quadric.along(on_quadric + t * along, across); };
  const double reach = wall + 2 * along.norm();
  const auto room = [&](double t) {
    const auto p = at(t);
    return p ? distance(*p, reach) - wall : -reach;
  };
  double end = 1;
  while (room(end) > 0)
    if (++end > 3) return std::nullopt;
  return room(0) > 0 ? at(zero(room, end, tolerance)) : std::nullopt;
}

/// Deeper than the wall by so much that facets between vertices at this depth keep it.
double depth_for(const Body& body, double wall, double cell, double spare) {
  if (!(cell > 0 && cell <= wall))
    throw InputError(fmt::format(
        "a wall of {:.3g} cells of the cavity's mesh; expected at least one (a finer mesh)", wall / cell));
  if (const double cells = bounding_box(body.local).extent().maxCoeff() / cell; cells > Grid::most_cells)
    throw InputError(
        fmt::format("a cavity's mesh of {:.0f} cells along the longest side; expected at most {}", cells,
                    Grid::most_cells));
  return std::sqrt(wall * wall + cell * cell / 3) + spare;
}

}  // namespace

CavityMesher::CavityMesher(const Body& body, double wall, double cell, double spare)
    : body_(body),
      depth_(depth_for(body, wall, cell, spare)),
      lattice_(bounding_box(body.local), cell),
      deep_(lattice_.size()),
      distance_(body.local) {
  for_each_inside(body.local, depth_ + margin * cell, lattice_,
                  [&](const Index& at) { deep_[lattice_.id(at)] = true; });
  if (std::ranges::find(deep_, true) == deep_.end())
    throw InputError(fmt::format(
        "wall of {:.4g} mm leaves an interior that is too small to be meshed in cells of {:.2g} mm; "
        "expected a thinner wall or a finer grid",
        wall * body.frame.length, cell * body.frame.length));
}

TriangleMesh CavityMesher::operator()(const Moments& q) const {
  const Quadric quadric(q);
  const double cell = lattice_.cell(), tolerance = 1e-7 * cell;
  std::vector<std::uint8_t> inside(lattice_.size());
  parallel_for(static_cast<std::size_t>(lattice_.n().z()), [&](std::size_t layer) {
    const int k = static_cast<int>(layer);
    for (int j = k % 2; j < lattice_.n().y(); j += 2)
      for (int i = k % 2; i < lattice_.n().x(); i += 2) {
        const std::size_t id = lattice_.id({i, j, k});
        if (!deep_[id]) continue;
        const Vec3 p = lattice_.point({i, j, k});
        inside[id] = quadric(p) > margin * cell * quadric.gradient(p).norm();
      }
  });

  std::unordered_map<std::uint64_t, double> fresh;
  std::mutex writing;
  TwoPieces surface;
  surface.place = [&](const Index& in, const Index& out) -> TwoPieces::Point {
    const Vec3 p = lattice_.point(in), d = lattice_.point(out) - p;
    // An edge is shorter than two walls, so it cannot pass through the skin and be as deep again outside it.
    // Not into the last bit before the other end: that is no deeper for the end being so.
    const double end = std::min(quadric.exit(p, d), 1 - margin);
    const std::uint64_t edge = std::uint64_t(lattice_.id(in)) << 32 | lattice_.id(out);
    const auto known = reached_.find(edge);
    const double deep = known != reached_.end()
                            ? std::min(end, known->second)
                            : stay_deep(distance_, body_.local, p, d, end, depth_, tolerance);
    if (deep < end && known == reached_.end()) {
      const std::scoped_lock lock(writing);
      fresh.emplace(edge, deep);
    }
    return {p + std::max(margin / 2, deep) * d, deep < end};
  };
  surface.meet = [&](const std::array<Vec3, 3>& face, const Vec3& on_quadric, const Vec3& on_offset) {
    return meeting_point(quadric, distance_, face, on_quadric, on_offset, depth_, tolerance);
  };
  TriangleMesh mesh = march(lattice_, inside, surface);
  reached_.merge(fresh);
  return turned_over(std::move(mesh));  // the void's boundary seen from inside it
}

TriangleMesh quadric_cavity(const Body& body, double wall, const Moments& q, double cell) {
  return CavityMesher(body, wall, cell)(q);
}

}  // namespace kreisel::core
