#include "body/models/revolve.hpp"

#include "geometry/polygon.hpp"

namespace kreisel::core {
namespace {

/// Walks round two rings at once and always steps on the one whose next vertex comes first. Angles are
/// compared as fractions, exactly.
void stitch(std::uint32_t low, int low_count, std::uint32_t high, int high_count, TriangleMesh& mesh) {
  const auto on = [](std::uint32_t first, int count, int i) { return first + std::uint32_t(i % count); };
  int i = 0, j = 0;
  const int low_steps = low_count == 1 ? 0 : low_count, high_steps = high_count == 1 ? 0 : high_count;
  while (i < low_steps || j < high_steps) {
    const auto next_low = std::int64_t(i + 1) * high_count, next_high = std::int64_t(j + 1) * low_count;
    const std::uint32_t a = on(low, low_count, i), b = on(high, high_count, j);
    if (j == high_steps || (i < low_steps && next_low <= next_high))
      mesh.triangles.push_back({a, on(low, low_count, ++i), b});
    else
      mesh.triangles.push_back({a, on(high, high_count, ++j), b});
  }
}

}  // namespace

TriangleMesh revolve(const std::vector<Ring>& rings) {
  TriangleMesh mesh;
  std::uint32_t below = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (const Vec2& p : circle(Vec2::Zero(), rings[r].radius, rings[r].count))
      mesh.vertices.emplace_back(p[0], p[1], rings[r].z);
    if (r > 0) stitch(below, rings[r - 1].count, first, rings[r].count, mesh);
    below = first;
  }
  return mesh;
}

}  // namespace kreisel::core
