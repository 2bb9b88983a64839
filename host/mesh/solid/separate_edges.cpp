#include "mesh/solid/separate_edges.hpp"

#include <optional>
#include <utility>

#include "geometry/predicates.hpp"
#include "mesh/query/sides.hpp"

namespace kreisel::core {
namespace {

/// Orders points by their angle about the line from a to b, counter-clockwise seen from b, from `start` on.
class AroundEdge {
 public:
  AroundEdge(const Vec3& a, const Vec3& b, const Vec3& start) : a_(a), b_(b), start_(start) {}

  /// -1, 0, 1: p before, on, behind q.
  [[nodiscard]] int compare(const Vec3& p, const Vec3& q) const {
    const int ph = half(p), qh = half(q);
    if (ph != qh) return ph < qh ? -1 : 1;
    return -orient3d(a_, b_, p, q);
  }

 private:
  /// 0: within the first half turn from start (included); 1: in the second (opposite of start included).
  [[nodiscard]] int half(const Vec3& p) const {
    const int side = orient3d(a_, b_, start_, p);
    if (side != 0) return side > 0 ? 0 : 1;
    // In the plane of the edge and start: on start's side of the line, or on the other?
    const int axis = projection_axis(a_, b_, start_);
    const auto a2 = drop(a_, axis), b2 = drop(b_, axis);
    return orient2d(a2, b2, drop(start_, axis)) == orient2d(a2, b2, drop(p, axis)) ? 0 : 1;
  }
  const Vec3 &a_, &b_, &start_;
};

/// The sides of an edge in their order around it, alternating, from a backward one on.
using Ring = std::vector<Side>;

/// Nothing where the sides do not alternate or two lie on each other.
std::optional<Ring> ring_of(const TriangleMesh& mesh, Ring sides) {
  if (sides.size() % 2) return std::nullopt;
  const auto apex = [&](const Side& s) -> const Vec3& {
    return mesh.vertices[mesh.triangles[s.triangle][(s.corner + 2u) % 3]];
  };
  const Vec3 &a = mesh.vertices[sides[0].low], &b = mesh.vertices[sides[0].high];
  for (const Side& s : sides)
    if (projection_axis(a, b, apex(s)) < 0) return std::nullopt;
  const AroundEdge around(a, b, apex(sides[0]));
  std::sort(sides.begin(), sides.end(),
            [&](const Side& s, const Side& t) { return around.compare(apex(s), apex(t)) < 0; });
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Side &s = sides[k], &next = sides[(k + 1) % sides.size()];
    if (s.forward == next.forward || around.compare(apex(s), apex(next)) == 0) return std::nullopt;
  }
  if (sides[0].forward) std::rotate(sides.begin(), sides.begin() + 1, sides.end());
  return sides;
}

/// A crowded edge and how its sides are paired. Going round, material begins behind a backward side and ends
/// at a forward one: pairs enclose material, or else what is between, so that the material runs through the
/// edge.
struct Crowded {
  Ring ring;
  bool around_material = true;

  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    const std::size_t first = around_material ? 0 : 1;
    for (std::size_t k = first; k < ring.size() + first; k += 2) visit(ring[k], ring[(k + 1) % ring.size()]);
  }
};

/// The mesh with a vertex for every fan that the pairs leave at the ends of the edges.
TriangleMesh split(const TriangleMesh& mesh, DisjointSets fans, const std::vector<Crowded>& edges) {
  std::vector<char> touched(mesh.vertices.size(), 0), taken(mesh.vertices.size(), 0);
  for (const Crowded& edge : edges) {
    touched[edge.ring[0].low] = touched[edge.ring[0].high] = 1;
    edge.for_each_pair([&](const Side& s, const Side& t) {
      for (const bool at_low : {true, false}) fans.join(s.corner_at(at_low), t.corner_at(at_low));
    });
  }
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> vertex_of_fan(3 * mesh.triangles.size(), none);
  TriangleMesh result = mesh;
  for (std::uint32_t corner = 0; corner < vertex_of_fan.size(); ++corner) {
    std::uint32_t& v = result.triangles[corner / 3][corner % 3];
    std::uint32_t& mine = vertex_of_fan[fans.find(corner)];
    if (mine == none) {
      mine = v;
      if (touched[v] && taken[v]) {  // the first fan keeps the vertex
        mine = std::uint32_t(result.vertices.size());
        result.vertices.push_back(mesh.vertices[v]);
      }
      taken[v] = 1;
    }
    v = mine;
  }
  return result;
}

/// Do two pairs still run between the same vertices? So it is where they hang together around both ends.
bool still_crowded(const TriangleMesh& mesh, const Crowded& edge) {
  std::vector<std::array<std::uint32_t, 2>> ends;
  const auto vertex = [&](const Side& s, bool at_low) {
    const std::uint32_t corner = s.corner_at(at_low);
    return mesh.triangles[corner / 3][corner % 3];
  };
  edge.for_each_pair([&](const Side& s, const Side&) {
    ends.push_back({vertex(s, true), vertex(s, false)});
  });
  std::sort(ends.begin(), ends.end());
  return std::adjacent_find(ends.begin(), ends.end()) != ends.end();
}

}  // namespace

std::size_t separate_edges(TriangleMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<Crowded> edges;
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first <= 2) return;
    if (auto ring = ring_of(mesh, {first, last})) edges.push_back({std::move(*ring)});
  });
  if (edges.empty()) return 0;
  const DisjointSets fans = corner_fans(mesh, sides);
  TriangleMesh result = split(mesh, fans, edges);
  bool changed = false;
  for (Crowded& edge : edges)
    if (still_crowded(result, edge)) {
      edge.around_material = false;
      changed = true;
    }
  if (changed) result = split(mesh, fans, edges);
  const auto separated =
      std::count_if(edges.begin(), edges.end(), [&](const Crowded& e) { return !still_crowded(result, e); });
  mesh = std::move(result);
  return std::size_t(separated);
}

}  // namespace kreisel::core
