#include "mesh/separate_edges.hpp"

#include <optional>

#include "mesh/predicates.hpp"
#include "mesh/sides.hpp"

namespace kreisel {
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

using Pairs = std::vector<std::pair<Side, Side>>;

/// The sides of one edge, paired around each wedge of material; nothing where that is not clear.
std::optional<Pairs> wedges(const TriangleMesh& mesh, std::vector<Side> sides) {
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
  Pairs pairs;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Side &s = sides[k], &next = sides[(k + 1) % sides.size()];
    if (s.forward == next.forward || around.compare(apex(s), apex(next)) == 0) return std::nullopt;
    // Going round, material begins behind a backward side and ends at a forward one.
    if (!s.forward) pairs.emplace_back(s, next);
  }
  return pairs;
}

}  // namespace

std::size_t separate_edges(TriangleMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  Pairs pairs;
  std::size_t separated = 0;
  std::vector<char> touched(mesh.vertices.size(), 0);  // ends of separated edges
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first <= 2) return;
    if (const auto found = wedges(mesh, {first, last})) {
      pairs.insert(pairs.end(), found->begin(), found->end());
      touched[first->low] = touched[first->high] = 1;
      ++separated;
    }
  });
  if (!separated) return 0;
  DisjointSets fans = corner_fans(mesh, sides);
  for (const auto& [s, t] : pairs)
    for (const bool at_low : {true, false}) fans.join(s.corner_at(at_low), t.corner_at(at_low));

  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> vertex_of_fan(3 * mesh.triangles.size(), none);
  std::vector<char> taken(mesh.vertices.size(), 0);  // the first fan keeps the vertex
  for (std::uint32_t corner = 0; corner < vertex_of_fan.size(); ++corner) {
    std::uint32_t& v = mesh.triangles[corner / 3][corner % 3];
    std::uint32_t& mine = vertex_of_fan[fans.find(corner)];
    if (mine == none) {
      mine = v;
      if (touched[v] && taken[v]) {
        mine = std::uint32_t(mesh.vertices.size());
        mesh.vertices.push_back(Vec3(mesh.vertices[v]));
      }
      if (v < taken.size()) taken[v] = 1;
    }
    v = mine;
  }
  return separated;
}

}  // namespace kreisel
