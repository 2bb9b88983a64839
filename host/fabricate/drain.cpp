#include "fabricate/drain.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "error.hpp"
#include "geometry/distance.hpp"
#include "geometry/fill_polygon.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/make/refine.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/solid/components.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

/// How far a surface may lean against a hole's cross-section: normals within 60 degrees of its axis.
constexpr double even = 0.5;

/// Coordinates along a hole: z into the material.
class Bore {
 public:
  explicit Bore(const Drain& drain) : from_(drain.from), rotation_(axis_to_z(drain.along)) {}

  [[nodiscard]] Vec3 operator()(const Vec3& p) const { return rotation_ * (p - from_); }
  [[nodiscard]] double off_axis(const Vec3& p) const { return (*this)(p).head<2>().norm(); }
  [[nodiscard]] double angle(const Vec3& p) const {
    const Vec3 at = (*this)(p);
    return std::atan2(at[1], at[0]);
  }

 private:
  Vec3 from_;
  Eigen::Matrix3d rotation_;
};

/// Does the bore's axis go through the triangle, or its rim?
bool on_axis(const Bore& bore, const TriangleMesh& mesh, const Triangle& t) {
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = bore(mesh.vertices[t[i]]);
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = cross(p[i].head<2>(), p[(i + 1) % 3].head<2>());
    left += side >= 0;
    right += side <= 0;
  }
  return left == 3 || right == 3;
}

/// Of the triangles on the bore's axis at or behind `depth` the first, and how far along the bore it lies.
std::optional<std::pair<std::size_t, double>> first_on_axis(const TriangleMesh& mesh, const Bore& bore,
                                                            double depth) {
  std::optional<std::pair<std::size_t, double>> first;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (!on_axis(bore, mesh, t)) continue;
    const double z = bore(middle_of(mesh, t))[2];
    if (z >= depth && (!first || z < first->second)) first = {i, z};
  }
  return first;
}

/// Whether a loop goes once around the bore, always the same way.
bool goes_around(const TriangleMesh& mesh, const Bore& bore, const Loop& loop) {
  double turned = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    double step = bore.angle(mesh.vertices[loop[(i + 1) % loop.size()]]) - bore.angle(mesh.vertices[loop[i]]);
    step -= 2 * std::numbers::pi * std::round(step / (2 * std::numbers::pi));
    if (turned * step < 0) return false;
    turned += step;
  }
  return true;
}

/// Cuts a disc out of a surface where the bore goes through it first at or behind `depth`.
/// @param towards  1 for a surface that faces along the bore, -1 for one that faces against it
/// @return  the rim, as the edges of what is left run along it; nothing where there is no even disc
std::optional<Loop> cut_disc(TriangleMesh& mesh, const Bore& bore, double radius, double depth, int towards,
                             const Vec3& along) {
  const auto seed = first_on_axis(mesh, bore, depth);
  if (!seed) return std::nullopt;

  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> owner;  // of a directed edge near the hole
  const auto near = [&](std::uint32_t v) {
    return bore.off_axis(mesh.vertices[v]) < 2 * radius &&
           std::abs(bore(mesh.vertices[v])[2] - seed->second) < 4 * radius;
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (const Triangle& t = mesh.triangles[i]; std::ranges::all_of(t, near))
      for (std::size_t k = 0; k < 3; ++k) owner[{t[k], t[(k + 1) % 3]}] = i;

  std::vector<bool> cut(mesh.triangles.size());
  std::vector<std::size_t> front = {seed->first};
  cut[seed->first] = true;
  while (!front.empty()) {
    const Triangle t = mesh.triangles[front.back()];
    front.pop_back();
    if (normal_of(mesh, t).normalized().dot(along) * towards < even) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto beyond = owner.find({t[(k + 1) % 3], t[k]});
      if (beyond == owner.end()) return std::nullopt;
      const Vec3 middle = middle_of(mesh, mesh.triangles[beyond->second]);
      if (cut[beyond->second] || bore.off_axis(middle) > radius) continue;
      cut[beyond->second] = true;
      front.push_back(beyond->second);
    }
  }
  std::map<std::uint32_t, std::uint32_t> rim;  // from what is cut: the next vertex along it
  for (const auto& [edge, triangle] : owner) {
    if (!cut[triangle] || cut[owner.at({edge.second, edge.first})]) continue;
    if (!rim.emplace(edge.second, edge.first).second) return std::nullopt;  // two rims touch in a vertex
  }
  const std::vector<Loop> loops = loops_along(std::move(rim));
  if (loops.size() != 1 || !goes_around(mesh, bore, loops.front()))
    return std::nullopt;  // more: a hole in it
  std::size_t i = 0;
  std::erase_if(mesh.triangles, [&](const Triangle&) { return cut[i++]; });
  return loops.front();
}

/// Triangles between two rims that run opposite ways around the bore.
void add_wall(TriangleMesh& mesh, const Bore& bore, const Loop& one, Loop other) {
  std::ranges::reverse(other);
  const auto angle = [&](std::uint32_t v) { return bore.angle(mesh.vertices[v]); };
  const auto apart = [](double a, double b) {
    return std::abs(a - b - 2 * std::numbers::pi * std::round((a - b) / (2 * std::numbers::pi)));
  };
  const auto start = std::ranges::min_element(
      other, {}, [&](std::uint32_t v) { return apart(angle(v), angle(one.front())); });
  std::rotate(other.begin(), start, other.end());
  std::size_t i = 0, j = 0;
  while (i < one.size() || j < other.size()) {
    const std::uint32_t a = one[i % one.size()], b = other[j % other.size()],
                        next_a = one[(i + 1) % one.size()], next_b = other[(j + 1) % other.size()];
    const bool step_one =
        j == other.size() || (i < one.size() && (mesh.vertices[next_a] - mesh.vertices[b]).norm() <
                                                    (mesh.vertices[next_b] - mesh.vertices[a]).norm());
    if (step_one) {
      mesh.triangles.push_back({next_a, a, b});
      ++i;
    } else {
      mesh.triangles.push_back({a, b, next_b});
      ++j;
    }
  }
}

void refine_about(TriangleMesh& mesh, const Bore& bore, double radius, double length) {
  split_edges(mesh, [&](const Vec3& a, const Vec3& b) {
    if ((a - b).norm() < radius / 3) return false;
    // The part of the edge that is nearest to the mouth of the bore.
    const Vec3 p = bore(a), d = bore(b) - p;
    const double t =
        std::clamp(-p.head<2>().dot(d.head<2>()) / std::max(d.head<2>().squaredNorm(), 1e-300), 0.0, 1.0);
    const Vec3 at = p + t * d;
    return at.head<2>().norm() < 1.8 * radius && at[2] > -2 * radius && at[2] < length + 2 * radius;
  });
}

/// The triangles that may be near a bore.
TriangleMesh about(const TriangleMesh& mesh, const Bore& bore, double radius) {
  TriangleMesh some;
  some.vertices = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    double nearest = std::numeric_limits<double>::infinity(), longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = mesh.vertices[t[i]];
      nearest = std::min(nearest, bore.off_axis(a));
      longest = std::max(longest, (a - mesh.vertices[t[(i + 1) % 3]]).norm());
    }
    if (nearest - longest < 3 * radius) some.triangles.push_back(t);
  }
  return some;
}

}  // namespace

namespace {

/// Where to drill into a void, if it can be drilled at one of the places looked at.
class Places {
 public:
  Places(const TriangleMesh& outer, const TriangleMesh& cavity, double radius, const Vec3& up)
      : outer_(outer), cavity_(cavity), radius_(radius), up_(up), distance_(outer) {}

  std::optional<Drain> place(const Shell& shell) const {
    std::vector<std::uint32_t> corners = corners_of_shell(shell);
    double least = bounding_box(outer_).extent().norm();
    for (const std::uint32_t v : corners) {
      stop_here();
      least = std::min(least, distance_(cavity_.vertices[v], least));
    }
    std::ranges::sort(corners, {}, [&](std::uint32_t v) { return up_.dot(cavity_.vertices[v]); });
    // Evenly from the lowest to the highest: neighbours would do no better than each other.
    constexpr std::size_t most_looked_at = 500, most_drilled = 50;
    const std::size_t step = std::max<std::size_t>(1, corners.size() / most_looked_at);
    std::size_t drilled_at = 0;
    for (std::size_t i = 0; i < corners.size() && drilled_at < most_drilled; i += step) {
      stop_here();
      const Vec3& p = cavity_.vertices[corners[i]];
      const auto nearest = distance_.nearest(p, 1.1 * least);
      if (!nearest) continue;
      ++drilled_at;
      const auto [a, b, c] = corners_of(outer_, outer_.triangles[*nearest]);
      const Vec3 q = nearest_on_triangle(p, a, b, c);
      if (const Drain drain{q, (p - q).normalized()}; can_be_drilled(drain)) return drain;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::vector<std::uint32_t> corners_of_shell(const Shell& shell) const {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t t : shell.triangles)
      corners.insert(corners.end(), cavity_.triangles[t].begin(), cavity_.triangles[t].end());
    std::ranges::sort(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
  }
  [[nodiscard]] bool can_be_drilled(const Drain& drain) const try {
    const Bore bore(drain);
    (void)drained(about(outer_, bore, radius_), about(cavity_, bore, radius_), {drain}, radius_);
    return true;
  } catch (const InputError&) {
    return false;
  }

  const TriangleMesh &outer_, &cavity_;
  double radius_;
  const Vec3& up_;
  SurfaceDistance distance_;
};

}  // namespace

std::vector<Drain> drains_of(const TriangleMesh& outer, const TriangleMesh& cavity, double radius,
                             const Vec3& up, const Control& control) {
  std::vector<Drain> drains;
  if (cavity.triangles.empty()) return drains;
  std::vector<Shell> voids = shells(cavity);
  std::erase_if(voids, [](const Shell& shell) { return shell.volume > 0; });  // islands
  const Places places(outer, cavity, radius, up);
  for (std::size_t i = 0; i < voids.size(); ++i) {
    control.tell(fmt::format("where to drain void {} of {}", i + 1, voids.size()));
    if (const auto drain = places.place(voids[i])) drains.push_back(*drain);
  }
  return drains;
}

TriangleMesh drained(const TriangleMesh& outer, const TriangleMesh& cavity, const std::vector<Drain>& drains,
                     double radius) {
  TriangleMesh mesh = joined({outer, cavity}, "the part");
  for (const Drain& drain : drains) {
    const Bore bore(drain);
    refine_about(mesh, bore, radius, 8 * radius);
    // The outer surface faces against the bore, the void's faces along it.
    const auto mouth = cut_disc(mesh, bore, radius, -radius, -1, drain.along);
    const auto end = mouth ? cut_disc(mesh, bore, radius, 0.1 * radius, 1, drain.along) : std::nullopt;
    if (!mouth || !end)
      throw InputError(
          fmt::format("a drain hole of {:.3g} mm radius at {:.4g} mm, where the wall is not even; expected "
                      "a smaller --drain",
                      radius, fmt::join(drain.from, ",")));
    add_wall(mesh, bore, *mouth, *end);
  }
  return mesh;
}

}  // namespace kreisel::core
