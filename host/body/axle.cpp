#include "body/axle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "error.hpp"
#include "geometry/moved.hpp"
#include "mesh/io/encode.hpp"
#include "mesh/make/cut_plane.hpp"
#include "mesh/make/prism.hpp"
#include "mesh/query/distance.hpp"

namespace kreisel::core {
namespace {

constexpr int sides = 48;  // of a circle as a polygon: its area is 0.3 % less

TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v[2] = -v[2];
  return turned_over(std::move(mesh));
}

/// Every point of a hole is within the radius of a segment of the axis, so the hole stays inside when the
/// surface is further from that. Sampled, less what the distance can change between samples.
double room_about(const SurfaceDistance& distance, double from, double to, double limit) {
  constexpr int samples = 64;
  const double step = (to - from) / samples;
  double least = limit;
  for (int i = 0; i <= samples; ++i) least = std::min(least, distance(Vec3(0, 0, from + i * step), limit));
  return least - std::abs(step) / 2;
}

}  // namespace

std::optional<Axle> axle_of(const AxleSpec& spec) {
  for (const auto& [name, value] :
       {std::pair{"axle", spec.radius}, std::pair{"slot", spec.slot}, std::pair{"axle depth", spec.depth}})
    if (value && !(*value > 0 && std::isfinite(*value)))
      throw InputError(fmt::format("{} {} mm; expected > 0", name, *value));
  if (!spec.radius) {
    if (spec.slot || spec.depth)
      throw InputError("a slot or a depth without an axle; expected --axle RADIUS, mm");
    return std::nullopt;
  }
  return Axle{*spec.radius, spec.slot.value_or(*spec.radius), spec.depth.value_or(2 * *spec.radius)};
}

TriangleMesh halves(const TriangleMesh& solid, const Axle& axle) {
  const SurfaceDistance distance(solid);
  const double mouth = axle.slot / 2, end = mouth + axle.depth, limit = 4 * axle.radius;
  const double room =
      std::min(room_about(distance, mouth, end, limit), room_about(distance, -end, -mouth, limit));
  // A twentieth to spare: the hole has a wall, if a thin one; the domain keeps its own from it.
  if (room < 1.05 * axle.radius)
    throw InputError(
        fmt::format("an axle of radius {:.3g} mm and holes of {:.3g} mm would break through the surface, "
                    "which comes as near as "
                    "{:.3g} mm to its axis; expected a thinner or shorter one",
                    axle.radius, axle.depth, std::max(room, 0.0)));
  const BlindHole hole{circle(Vec2::Zero(), axle.radius, sides), axle.depth};
  return joined({above_plane(solid, mouth, hole), mirrored(above_plane(mirrored(solid), mouth, hole))},
                "the halves");
}

TriangleMesh axle_mesh(const Axle& axle) {
  const double end = axle.slot / 2 + axle.depth;
  return prism(circle(Vec2::Zero(), axle.radius, sides), -end, end);
}

TriangleMesh half_of(const TriangleMesh& mesh, bool upper) {
  std::vector<std::uint32_t> half;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if ((mesh.vertices[mesh.triangles[t][0]][2] > 0) == upper) half.push_back(t);
  return part_of(mesh, half);
}

}  // namespace kreisel::core
