#include "mesh/make/prism.hpp"

#include <cmath>
#include <numbers>

namespace kreisel::core {

std::vector<Point2> circle(const Point2& centre, double radius, int sides) {
  std::vector<Point2> polygon;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    polygon.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
  }
  return polygon;
}

TriangleMesh prism(const std::vector<Point2>& polygon, double bottom, double top) {
  TriangleMesh mesh;
  const auto sides = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {bottom, top})
    for (const Point2& p : polygon) mesh.vertices.emplace_back(p[0], p[1], z);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    mesh.triangles.push_back({i, j, sides + j});
    mesh.triangles.push_back({i, sides + j, sides + i});
  }
  for (std::uint32_t i = 1; i + 1 < sides; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({sides, sides + i, sides + i + 1});
  }
  return mesh;
}

}  // namespace kreisel::core
