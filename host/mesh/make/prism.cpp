#include "mesh/make/prism.hpp"

#include <numeric>

#include "geometry/fill_polygon.hpp"

namespace kreisel::core {

TriangleMesh prism(std::span<const Vec2> polygon, double bottom, double top) {
  TriangleMesh mesh;
  const auto sides = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {bottom, top})
    for (const Vec2& p : polygon) mesh.vertices.emplace_back(p[0], p[1], z);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    mesh.triangles.push_back({i, j, sides + j});
    mesh.triangles.push_back({i, sides + j, sides + i});
  }
  Loop loop(sides);
  std::iota(loop.begin(), loop.end(), 0u);
  for (const auto& [a, b, c] : fill_polygon(polygon, {loop})) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({sides + a, sides + b, sides + c});
  }
  return mesh;
}

}  // namespace kreisel::core
