#include "mesh/solid/repair.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/predicates.hpp"
#include "mesh/make/flip_flat.hpp"
#include "mesh/query/equal_vertices.hpp"
#include "mesh/query/sides.hpp"
#include "mesh/solid/orient.hpp"
#include "mesh/solid/separate_edges.hpp"
#include "mesh/solid/weld.hpp"

namespace kreisel::core {
namespace {

std::string counted(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

/// Edges that do not have exactly two triangles.
struct EdgeCounts {
  std::size_t open = 0, crowded = 0;
  [[nodiscard]] bool closed() const { return !open && !crowded; }
};

EdgeCounts count_edges(const TriangleMesh& mesh) {
  EdgeCounts counts;
  for_each_edge(sorted_sides(mesh), [&](auto first, auto last) {
    counts.open += last - first == 1;
    counts.crowded += last - first > 2;
  });
  return counts;
}

std::size_t drop_unused_vertices(TriangleMesh& mesh) {
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), none);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) renumbered[v] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v)
    if (renumbered[v] != none) {
      mesh.vertices[kept] = mesh.vertices[v];
      renumbered[v] = kept++;
    }
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = renumbered[v];
  const std::size_t dropped = mesh.vertices.size() - kept;
  mesh.vertices.resize(kept);
  return dropped;
}

void merge_equal_vertices(TriangleMesh& mesh, RepairReport& report) {
  const std::vector<std::uint32_t> first = first_equal_vertex(mesh.vertices);
  std::size_t equal = 0;
  for (std::uint32_t v = 0; v < first.size(); ++v) equal += first[v] != v;
  if (!equal) return;
  TriangleMesh merged = mesh;
  for (Triangle& t : merged.triangles)
    for (std::uint32_t& v : t) v = first[v];
  if (count_edges(mesh).closed() && count_edges(merged).crowded) {
    report.lines.push_back(fmt::format("left {} apart: merged, edges would have more than two triangles",
                                       counted(equal, "equal vertex", "equal vertices")));
    return;
  }
  (void)drop_unused_vertices(merged);
  mesh = std::move(merged);
  report.lines.push_back("merged " + counted(equal, "equal vertex", "equal vertices"));
}

/// Removes the triangles for which drop(triangle) holds. @return  how many
template <class Predicate>
std::size_t drop_triangles(TriangleMesh& mesh, Predicate drop) {
  return std::erase_if(mesh.triangles, drop);
}

void weld_corners(TriangleMesh& mesh, double within, RepairReport& report) {
  const std::size_t welded = weld_open_edges(mesh, within);
  if (!welded) return;
  (void)drop_unused_vertices(mesh);
  report.lines.push_back(fmt::format("welded {} at open edges, no more than {:.2g} apart",
                                     counted(welded, "vertex to another", "vertices to others"), within));
}

bool repeats_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Drops the triangles of the numbers for which the predicate holds if a closed surface is left.
template <class Predicate>
void drop_if_closed(TriangleMesh& mesh, Predicate drop, const char* one, const char* many,
                    RepairReport& report) {
  TriangleMesh candidate;
  std::size_t dropped = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!drop(t)) {
      if (dropped > 0) candidate.triangles.push_back(mesh.triangles[t]);
    } else if (dropped++ == 0) {
      candidate = {mesh.vertices, {mesh.triangles.begin(), mesh.triangles.begin() + t}};
    }
  }
  if (!dropped || candidate.triangles.empty() || !count_edges(candidate).closed()) return;
  mesh = std::move(candidate);
  report.lines.push_back("dropped " + counted(dropped, one, many));
}

void drop_useless_triangles(TriangleMesh& mesh, RepairReport& report) {
  if (const std::size_t n = drop_triangles(mesh, repeats_vertex))
    report.lines.push_back("dropped " + counted(n, "triangle that uses", "triangles that use") +
                           " a vertex twice");
  const auto without_area = [&](std::uint32_t i) {
    const Triangle& t = mesh.triangles[i];
    return projection_axis(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]) < 0;
  };
  drop_if_closed(mesh, without_area, "triangle without area", "triangles without area", report);
  const std::vector<std::uint32_t> first = first_equal_triangle(mesh.triangles);
  drop_if_closed(
      mesh, [&](std::uint32_t i) { return first[i] != i; }, "repeated triangle", "repeated triangles",
      report);
}

void orient(TriangleMesh& mesh, RepairReport& report) {
  if (const std::size_t n = orient_shells(mesh))
    report.lines.push_back("turned " + counted(n, "triangle", "triangles") +
                           " to run the same way round as the rest");
  if (const std::size_t n = flip_flat_triangles(mesh))
    report.lines.push_back("flipped " + counted(n, "triangle without area into its neighbour",
                                                "triangles without area into their neighbours"));
  (void)turn_outward(mesh, shells(mesh), report);
}

}  // namespace

bool turn_outward(TriangleMesh& mesh, const std::vector<Shell>& all, RepairReport& report) {
  for (const Shell& shell : all)
    if (!shell.closed || !shell.oriented) return false;  // no inside, no outside
  const std::size_t n = face_outward(mesh, all);
  if (n) report.lines.push_back("turned " + counted(n, "inside-out shell", "inside-out shells"));
  return n > 0;
}

TriangleMesh repaired(TriangleMesh mesh, RepairReport& report, double weld) {
  std::size_t unused = drop_unused_vertices(mesh);
  merge_equal_vertices(mesh, report);
  weld_corners(mesh, weld, report);
  drop_useless_triangles(mesh, report);
  if (const std::size_t n = separate_edges(mesh))
    report.lines.push_back("separated " + counted(n, "edge", "edges") + " at which parts of the solid touch");
  unused += drop_unused_vertices(mesh);
  if (unused) report.lines.push_back("dropped " + counted(unused, "unused vertex", "unused vertices"));
  orient(mesh, report);
  return mesh;
}

}  // namespace kreisel::core
