// sides.hpp - the sides of all triangles, sorted so that those of one edge lie together.
#pragma once

#include <algorithm>
#include <vector>

#include "disjoint_sets.hpp"
#include "geometry/triangle_mesh.hpp"
#include "stop.hpp"

namespace kreisel::core {

/// The side of a triangle from its corner `corner` to the next. Small, for a mesh has three a triangle.
struct Side {
  static constexpr int triangle_bits = 29;
  std::uint32_t low, high;  ///< ends, by vertex index
  std::uint32_t triangle : triangle_bits;
  std::uint32_t corner : 2;  ///< 0, 1 or 2
  bool forward : 1;          ///< runs from low to high

  [[nodiscard]] bool same_edge(const Side& o) const { return low == o.low && high == o.high; }
  /// Number of its corner at the end `low` (or `high`) among all 3 * triangles corners.
  [[nodiscard]] std::uint32_t corner_at(bool at_low) const {
    return 3 * triangle + (at_low == forward ? corner : (corner + 1u) % 3u);
  }
};

/// All sides but those from a vertex to itself; by edge, then by triangle.
/// @throws InputError  2^29 triangles or more
[[nodiscard]] std::vector<Side> sorted_sides(const TriangleMesh& mesh);

/// Calls visit(first, last) for the sides of each edge in turn. @param sides  as from sorted_sides()
template <class Visit>
void for_each_edge(const std::vector<Side>& sides, Visit&& visit) {
  for (auto first = sides.begin(); first != sides.end();) {
    stop_here();
    const auto last = std::find_if(first, sides.end(), [&](const Side& s) { return !s.same_edge(*first); });
    visit(first, last);
    first = last;
  }
}

/// The corners of triangles (3 * triangle + k) joined across every edge of exactly two triangles: each set is
/// a fan around one vertex. A vertex with more than one fan is where parts of the surface merely touch.
[[nodiscard]] DisjointSets corner_fans(const TriangleMesh& mesh, const std::vector<Side>& sides);

/// How the triangles of a mesh hang together, for more than one question about it.
struct Topology {
  explicit Topology(const TriangleMesh& mesh) : sides(sorted_sides(mesh)), fans(corner_fans(mesh, sides)) {}

  std::vector<Side> sides;
  DisjointSets fans;
};

}  // namespace kreisel::core
