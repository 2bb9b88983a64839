#include "mesh/solid/arrange.hpp"

#include <algorithm>
#include <map>

#include "geometry/cut_triangle.hpp"
#include "geometry/triangle.hpp"
#include "geometry/triangles_meet.hpp"
#include "mesh/query/equal_vertices.hpp"
#include "mesh/query/sides.hpp"

namespace kreisel::core {
namespace {

std::array<double, 3> place(const ExactPoint& p) { return {p.near()[0], p.near()[1], p.near()[2]}; }

/// What the triangles of the pairs have in common, by triangle.
std::map<std::uint32_t, std::vector<Segment>> contacts(
    const TriangleMesh& mesh, const std::vector<std::uint32_t>& number_of,
    const std::vector<std::array<std::uint32_t, 2>>& crossings, PointSet& points) {
  const auto corners = [&](std::uint32_t t) -> CornersOf {
    const auto& [a, b, c] = mesh.triangles[t];
    return {{number_of[a], number_of[b], number_of[c]}, corners_of(mesh, mesh.triangles[t])};
  };
  const PointOf point = [&](std::uint32_t p) -> const ExactPoint& { return points[p]; };
  const auto number = [&](ExactPoint p) { return points.number(std::move(p)); };
  for (const auto& pair : crossings)
    for (const std::uint32_t t : pair)
      for (const std::uint32_t v : mesh.triangles[t]) points.know(number_of[v]);
  std::map<std::uint32_t, std::vector<Segment>> found;
  for (const auto& [s, t] : crossings) {
    stop_here();
    const std::vector<Segment> common = triangles_meet(corners(s), corners(t), point, number);
    for (const std::uint32_t of : {s, t}) found[of].insert(found[of].end(), common.begin(), common.end());
  }
  return found;
}

/// The faces with points that are about right.
TriangleMesh near_mesh(const Arrangement& arrangement) {
  TriangleMesh mesh{{}, arrangement.faces};
  mesh.vertices.reserve(arrangement.points.size());
  for (std::uint32_t p = 0; p < arrangement.points.size(); ++p)
    mesh.vertices.push_back(arrangement.points.near(p));
  return mesh;
}

}  // namespace

void PointSet::know(std::uint32_t vertex) {
  if (exact_[vertex]) return;
  exact_[vertex] = std::make_unique<ExactPoint>(vertices_[vertex]);
  by_place_.emplace(place(*exact_[vertex]), vertex);
}

std::uint32_t PointSet::number(ExactPoint point) {
  const auto [first, last] = by_place_.equal_range(place(point));
  for (auto i = first; i != last; ++i)
    if (*exact_[i->second] == point) return i->second;
  const auto added = std::uint32_t(exact_.size());
  by_place_.emplace(place(point), added);
  exact_.push_back(std::make_unique<ExactPoint>(std::move(point)));
  return added;
}

const ExactPoint& PointSet::operator[](std::uint32_t number) const {
  if (!exact_[number]) exact_[number] = std::make_unique<ExactPoint>(vertices_[number]);
  return *exact_[number];
}

Arrangement arrange(const TriangleMesh& mesh, const std::vector<std::array<std::uint32_t, 2>>& crossings) {
  Arrangement made(mesh.vertices);
  const std::vector<std::uint32_t> number_of = first_equal_vertex(mesh.vertices);
  const auto cuts = contacts(mesh, number_of, crossings, made.points);
  const PointOf point = [&](std::uint32_t p) -> const ExactPoint& { return made.points[p]; };
  const auto number = [&](ExactPoint p) { return made.points.number(std::move(p)); };
  std::map<std::uint32_t, std::set<Segment>> lines;  // of the triangles that are cut
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    stop_here(t);
    const auto& [a, b, c] = mesh.triangles[t];
    const Triangle corners{number_of[a], number_of[b], number_of[c]};
    if (const auto cut = cuts.find(t); cut != cuts.end()) {
      TrianglePieces pieces = cut_triangle(corners, cut->second, point, number);
      for (const Triangle& piece : pieces.triangles) {
        made.faces.push_back(piece);
        made.source.push_back(t);
      }
      lines[t] = std::move(pieces.lines);
    } else if (projection_axis(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) >= 0) {
      made.faces.push_back(corners);
      made.source.push_back(t);
    }
  }
  // A patch goes on across what is no line, and across edges where nothing else is.
  DisjointSets patches(made.faces.size());
  for_each_edge(sorted_sides(near_mesh(made)), [&](auto first, auto last) {
    std::ptrdiff_t sum = 0;
    for (auto side = first; side != last; ++side) sum += side->forward ? 1 : -1;
    made.closed = made.closed && sum == 0;
    if (last - first == 2 && first->forward != (first + 1)->forward) {
      patches.join(first->triangle, (first + 1)->triangle);
      return;
    }
    for (auto side = first; side != last; ++side) {
      const std::uint32_t t = made.source[side->triangle];
      const auto drawn = lines.find(t);
      if (drawn == lines.end() || drawn->second.contains({side->low, side->high})) continue;
      for (auto other = first; other != side; ++other)
        if (made.source[other->triangle] == t) patches.join(other->triangle, side->triangle);
    }
  });
  for (std::uint32_t f = 0; f < made.faces.size(); ++f) made.patch.push_back(patches.find(f));
  return made;
}

}  // namespace kreisel::core
