#include "fabricate/cut_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "error.hpp"
#include "geometry/distance.hpp"
#include "geometry/moved.hpp"
#include "geometry/predicates.hpp"
#include "geometry/single_precision.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/make/cut_plane.hpp"
#include "mesh/make/prism.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/solid/repair.hpp"

namespace kreisel::core {
namespace {

/// The middle of the widest gap between the heights of vertices, of those within `reach` of `wanted`.
double clear_of_corners(const TriangleMesh& mesh, double wanted, double reach) {
  std::vector<double> heights = {wanted - reach, wanted + reach};
  for (const Vec3& v : mesh.vertices)
    if (std::abs(v[2] - wanted) < reach) heights.push_back(v[2]);
  std::ranges::sort(heights);
  std::size_t widest = 1;
  for (std::size_t i = 2; i < heights.size(); ++i)
    if (heights[i] - heights[i - 1] > heights[widest] - heights[widest - 1]) widest = i;
  return (heights[widest] + heights[widest - 1]) / 2;
}

/// A part turned so that the plane is horizontal.
struct Level {
  Eigen::Matrix3d rotation;
  TriangleMesh mesh;
  double height;  ///< of the plane
  /// That corners keep from the plane, moved by no more than as much: some ten times the spacing of single
  /// precision, so that what is left of a triangle is no sliver that rounding turns over.
  double clearance;

  /// @param solid  in single precision
  Level(const TriangleMesh& solid, const Plane& plane)
      : rotation(axis_to_z(plane.normal)), mesh(moved(solid, rotation)) {
    const double size = bounding_box(mesh).extent().maxCoeff();
    height = clear_of_corners(mesh, plane.offset / plane.normal.norm(), 1e-3 * size);
    clearance = 4e-6 * size;
    keep_clear(mesh);
  }

  /// Out of the cut of the half above or below, model coordinates.
  [[nodiscard]] Vec3 down(bool above) const { return (above ? -1 : 1) * rotation.row(2).transpose(); }

  /// Of the same coordinates as `mesh`.
  void keep_clear(TriangleMesh& level) const {
    for (Vec3& v : level.vertices) {
      const double above = v[2] - height;
      if (std::abs(above) < clearance) v[2] = height + std::copysign(clearance, above);
    }
  }
};

/// How far a point is inside the material, up to a limit; negative outside. By the triangle nearest to it,
/// which misjudges sides only near sharp edges.
double depth_of(const SurfaceDistance& distance, const TriangleMesh& mesh, const Vec3& p, double limit) {
  const auto nearest = distance.nearest(p, limit);
  if (!nearest) return limit;
  const auto [a, b, c] = corners_of(mesh, mesh.triangles[*nearest]);
  const double from = distance_to_triangle(p, a, b, c);
  return normal_of(a, b, c).dot(p - a) < 0 ? from : -from;
}

/// Two places for pegs, or one where there is no room for two.
std::vector<Vec2> places(const Level& level, const Pegs& pegs) {
  const SurfaceDistance distance(level.mesh);
  const Box box = bounding_box(level.mesh);
  const double needed = 1.5 * pegs.radius, limit = box.extent().norm();
  std::vector<Vec2> free;
  const auto has_room = [&](double x, double y) {
    constexpr int samples = 4;  // half a radius apart, as much as there is to spare
    for (int i = -samples; i <= samples; ++i)
      if (depth_of(distance, level.mesh, {x, y, level.height + pegs.depth() * i / samples}, limit) < needed)
        return false;
    return true;
  };
  const double step = std::max(pegs.radius / 2, box.extent().maxCoeff() / 100);
  for (double y = box.lo[1]; y < box.hi[1]; y += step)
    for (double x = box.lo[0]; x < box.hi[0]; x += step)
      if (has_room(x, y)) free.emplace_back(x, y);
  if (free.empty())
    throw InputError(
        fmt::format("no room for a peg of {:.3g} mm radius in the cut; expected a smaller one, or "
                    "another plane",
                    pegs.radius));
  const auto apart = [](const Vec2& a, const Vec2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); };
  // From anywhere to the farthest, and from there: as far apart as it gets, or nearly.
  const auto farthest = [&](const Vec2& from) {
    return *std::ranges::max_element(free, {}, [&](const Vec2& p) { return apart(p, from); });
  };
  const Vec2 one = farthest(free.front()), other = farthest(one);
  return apart(one, other) > 4 * pegs.radius ? std::vector{one, other} : std::vector{one};
}

/// What of a solid lies above or below the plane, in single precision; empty where there is nothing.
/// @param place  what the coordinates are about
TriangleMesh half_of(const TriangleMesh& solid, bool above, const Level& level,
                     const std::vector<Vec2>& pegs_at, const Pegs& pegs, const Vec3& place) {
  const Eigen::Matrix3d over = above ? Vec3(1, 1, 1).asDiagonal() : Vec3(1, -1, -1).asDiagonal();
  const Eigen::Matrix3d turn = over * level.rotation;
  std::vector<BlindHole> holes;
  for (const Vec2& at : pegs_at)
    holes.push_back({circle({at[0], above ? at[1] : -at[1]}, pegs.radius, Pegs::sides), pegs.depth()});
  TriangleMesh flat = moved(solid, level.rotation);
  level.keep_clear(flat);
  // The cap by the coordinates that change most along it.
  int axis = 0;
  const Vec3 upwards = turn.row(2);
  upwards.cwiseAbs().maxCoeff(&axis);
  const auto as_written = [&](const Vec3& v) { return in_single_precision(turn.transpose() * v, place); };
  const WrittenAs written{[&](const Vec3& v) -> Vec3 { return turn * as_written(v); },
                          [&](const Vec3& v) -> Vec2 {
                            const Vec2 p = drop(as_written(v), axis);
                            return upwards[axis] < 0 ? p : Vec2(p[1], p[0]);
                          }};
  TriangleMesh mesh =
      above_plane(moved(std::move(flat), over), above ? level.height : -level.height, holes, written);
  mesh = in_single_precision(moved(std::move(mesh), turn.transpose()),
                             place);  // there and back is round-off off
  RepairReport ignored;
  return mesh.triangles.empty() ? mesh : repaired(std::move(mesh), ignored);
}

/// A pin where it belongs, model coordinates.
TriangleMesh pin(const Level& level, const Vec2& at, const Pegs& pegs) {
  const double radius = pegs.radius - Pegs::clearance, end = pegs.depth() - Pegs::clearance;
  return moved(prism(circle(at, radius, Pegs::sides), level.height - end, level.height + end),
               level.rotation.transpose());
}

void add_pins(std::vector<MaterialPart>& pins, const Level& level, const std::vector<Vec2>& at,
              const Pegs& pegs, double density) {
  for (const Vec2& p : at)
    pins.push_back(
        {fmt::format("peg-{}", pins.size() + 1), density, {pin(level, p, pegs)}, level.down(true)});
}

[[noreturn]] void refuse_plane_that_misses(const Plane& plane) {
  throw InputError(fmt::format("the plane {:.4g} . x = {:.4g} misses the part; expected one that cuts it",
                               fmt::join(plane.normal, ","), plane.offset));
}

void require_pegs_fit(const Pegs& pegs, std::size_t planes) {
  if (pegs.radius > 0 && (planes != 1 || pegs.radius <= Pegs::clearance))
    throw InputError(
        fmt::format("pegs of {:.3g} mm radius and {} planes; expected one plane, and more than {} mm",
                    pegs.radius, planes, Pegs::clearance));
}

/// The surfaces as one, about the part's place, in single precision.
TriangleMesh about_place(const MaterialPart& part) {
  return in_single_precision(moved(joined(part.surfaces, part.name), Eigen::Translation3d(-part.place)),
                             part.place);
}

}  // namespace

std::vector<MaterialPart> cut_part(const MaterialPart& part, std::span<const Plane> planes,
                                   const Pegs& pegs) {
  require_pegs_fit(pegs, planes.size());
  std::vector<MaterialPart> pieces = {{part.name, part.density, {about_place(part)}}};
  std::vector<MaterialPart> pins;
  for (const Plane& far : planes) {
    const Plane plane{far.normal, -far.above(part.place)};  // about the place
    std::vector<MaterialPart> next;
    for (const MaterialPart& piece : pieces) {
      const TriangleMesh& solid = piece.surfaces.front();
      const Level level(solid, plane);
      const std::vector<Vec2> at = pegs.radius > 0 ? places(level, pegs) : std::vector<Vec2>{};
      const std::size_t before = next.size();
      for (const bool above : {true, false})
        if (TriangleMesh half = half_of(solid, above, level, at, pegs, part.place); !half.triangles.empty())
          next.push_back({"", part.density, {std::move(half)}, level.down(above)});
      if (next.size() == before + 1) next.back().down = piece.down;  // the plane missed it
      add_pins(pins, level, at, pegs, part.density);
    }
    if (next.size() == pieces.size()) refuse_plane_that_misses(far);
    pieces = std::move(next);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i)
    pieces[i].name = pieces.size() == 2 ? (i == 0 ? "upper" : "lower") : fmt::format("piece-{}", i + 1);
  for (MaterialPart& peg : pins) pieces.push_back(std::move(peg));
  for (MaterialPart& piece : pieces) {
    piece.place = part.place;
    for (TriangleMesh& surface : piece.surfaces)
      surface = moved(std::move(surface), Eigen::Translation3d(part.place));
  }
  return pieces;
}

std::vector<MaterialPart> cut_in_halves(const TriangleMesh& solid, const HalfVoids& voids, const Plane& plane,
                                        double density, const Pegs& pegs) {
  require_pegs_fit(pegs, 1);
  // The plane, and room for pegs, by both voids.
  const Level level(in_single_precision(joined({solid, voids.upper, voids.lower}, "solid")), plane);
  const std::vector<Vec2> at = pegs.radius > 0 ? places(level, pegs) : std::vector<Vec2>{};
  std::vector<MaterialPart> parts;
  for (const bool above : {true, false}) {
    const char* name = above ? "upper" : "lower";
    const TriangleMesh whole = in_single_precision(joined({solid, above ? voids.upper : voids.lower}, name));
    TriangleMesh half = half_of(whole, above, level, at, pegs, Vec3::Zero());
    if (half.triangles.empty()) refuse_plane_that_misses(plane);
    parts.push_back({name, density, {std::move(half)}, level.down(above)});
  }
  std::vector<MaterialPart> pins;
  add_pins(pins, level, at, pegs, density);
  for (MaterialPart& peg : pins) parts.push_back(std::move(peg));
  return parts;
}

}  // namespace kreisel::core
