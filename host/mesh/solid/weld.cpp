#include "mesh/solid/weld.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "geometry/exact_point_hash.hpp"
#include "mesh/query/sides.hpp"

namespace kreisel::core {
namespace {

/// Edges of one triangle.
std::vector<Side> open_sides(const TriangleMesh& mesh) {
  std::vector<Side> open;
  for_each_edge(sorted_sides(mesh), [&](auto first, auto last) {
    if (last - first == 1) open.push_back(*first);
  });
  return open;
}

/// Points no two of which are within a distance, found by cubes of that edge.
class ApartPoints {
 public:
  explicit ApartPoints(double within) : within_(within) {}

  /// The nearest one within the distance; or nothing, and the point is one of them from now on.
  std::optional<std::uint32_t> near(const Vec3& p, std::uint32_t index) {
    std::optional<std::uint32_t> nearest;
    double least = within_;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto [from, to] = cubes_.equal_range(cube_of(p + within_ * Vec3(x, y, z)));
          for (auto at = from; at != to; ++at)
            if (const double distance = (at->second.point - p).norm(); distance <= least) {
              least = distance;
              nearest = at->second.index;
            }
        }
    if (!nearest) cubes_.emplace(cube_of(p), Point{p, index});
    return nearest;
  }

 private:
  using Cube = std::array<double, 3>;  // whole numbers, of any size
  struct Point {
    Vec3 point;
    std::uint32_t index;
  };
  [[nodiscard]] Cube cube_of(const Vec3& p) const {
    // -0 + 0 is 0, which has the same hash
    return {std::floor(p[0] / within_) + 0.0, std::floor(p[1] / within_) + 0.0,
            std::floor(p[2] / within_) + 0.0};
  }

  double within_;
  std::unordered_multimap<Cube, Point, ExactPointHash> cubes_;
};

}  // namespace

std::size_t weld_open_edges(TriangleMesh& mesh, double within) {
  if (!(within > 0)) return 0;
  const std::vector<Side> open = open_sides(mesh);
  if (open.empty()) return 0;
  std::vector<bool> at_open_edge(mesh.vertices.size());
  for (const Side& side : open) at_open_edge[side.low] = at_open_edge[side.high] = true;

  std::vector<std::uint32_t> joined(mesh.vertices.size());
  std::size_t count = 0;
  ApartPoints apart(within);
  for (std::uint32_t v = 0; v < joined.size(); ++v) {
    joined[v] = at_open_edge[v] ? apart.near(mesh.vertices[v], v).value_or(v) : v;
    count += joined[v] != v;
  }
  if (!count) return 0;
  TriangleMesh welded = mesh;
  for (Triangle& t : welded.triangles)
    for (std::uint32_t& v : t) v = joined[v];
  std::erase_if(welded.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  if (open_sides(welded).size() >= open.size()) return 0;
  mesh = std::move(welded);
  return count;
}

}  // namespace kreisel::core
