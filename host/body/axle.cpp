#include "body/axle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "error.hpp"
#include "mesh/make/cut_plane.hpp"
#include "mesh/make/prism.hpp"
#include "mesh/query/distance.hpp"

namespace kreisel::core {
namespace {

constexpr int sides = 48;  // of a circle as a polygon: its area is 0.3 % less

TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v[2] = -v[2];
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

void append(TriangleMesh& to, const TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const Triangle& t : mesh.triangles) to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
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
  const BlindHole hole{circle({0, 0}, axle.radius, sides), axle.depth};
  TriangleMesh both = above_plane(solid, mouth, hole);
  append(both, mirrored(above_plane(mirrored(solid), mouth, hole)));
  return both;
}

TriangleMesh axle_mesh(const Axle& axle) {
  const double end = axle.slot / 2 + axle.depth;
  return prism(circle({0, 0}, axle.radius, sides), -end, end);
}

TriangleMesh half_of(const TriangleMesh& mesh, bool upper) {
  TriangleMesh half;
  std::map<std::uint32_t, std::uint32_t> kept;
  for (const Triangle& t : mesh.triangles) {
    if ((mesh.vertices[t[0]][2] > 0) != upper) continue;
    Triangle& out = half.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [entry, fresh] = kept.try_emplace(t[i], static_cast<std::uint32_t>(half.vertices.size()));
      if (fresh) half.vertices.push_back(mesh.vertices[t[i]]);
      out[i] = entry->second;
    }
  }
  return half;
}

}  // namespace kreisel::core
