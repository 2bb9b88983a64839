#include "mesh/solid/pieces.hpp"

#include <algorithm>
#include <map>

#include "geometry/moved.hpp"
#include "mesh/query/equal_vertices.hpp"

namespace kreisel::core {
namespace {

/// The shell around a cavity that is inside no other within it.
std::uint32_t nearest_around(const Surface::Nesting& around, std::uint32_t shell) {
  return *std::ranges::max_element(around[shell], {}, [&](std::uint32_t s) { return around[s].size(); });
}

}  // namespace

std::vector<Piece> pieces_of(Surface& surface) {
  const TriangleMesh& mesh = surface.mesh();
  const std::vector<Shell>& shells = surface.shells();
  DisjointSets together(shells.size());
  if (shells.size() > 1) {
    const Surface::Nesting& around = surface.enclosing();
    const std::vector<std::uint32_t> place = first_equal_vertex(mesh.vertices);
    std::vector<std::uint32_t> at(mesh.vertices.size(), ~0u);
    for (std::uint32_t s = 0; s < shells.size(); ++s) {
      if (around[s].size() % 2 == 1) together.join(s, nearest_around(around, s));
      for (const std::uint32_t t : shells[s].triangles)
        for (const std::uint32_t v : mesh.triangles[t]) {
          std::uint32_t& there = at[place[v]];
          if (there == ~0u) there = s;
          together.join(s, there);
        }
    }
  }
  std::map<std::uint32_t, Piece> by_first;
  std::map<std::uint32_t, Box> boxes;
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    const std::uint32_t first = together.find(s);
    Piece& piece = by_first[first];
    piece.shells.push_back(s);
    piece.volume += shells[s].volume;
    boxes[first].add(shells[s].box.lo);
    boxes[first].add(shells[s].box.hi);
  }
  std::vector<Piece> pieces;
  for (auto& [first, piece] : by_first) {
    piece.at = boxes[first].centre();
    pieces.push_back(std::move(piece));
  }
  std::ranges::stable_sort(pieces, std::greater(), &Piece::volume);
  return pieces;
}

TriangleMesh mesh_of(Surface& surface, const std::vector<Piece>& chosen) {
  std::vector<std::uint32_t> triangles;
  for (const Piece& piece : chosen)
    for (const std::uint32_t s : piece.shells)
      triangles.insert(triangles.end(), surface.shells()[s].triangles.begin(),
                       surface.shells()[s].triangles.end());
  std::ranges::sort(triangles);
  return part_of(surface.mesh(), triangles);
}

}  // namespace kreisel::core
