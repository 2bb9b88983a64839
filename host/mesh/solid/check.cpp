#include "mesh/solid/check.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "error.hpp"
#include "geometry/predicates.hpp"
#include "mesh/query/equal_vertices.hpp"

namespace kreisel::core {
namespace {

void note(EdgeFault& fault, const Side& side) {
  if (!fault.count++) fault.first = {side.low, side.high};
}

/// Of the triangles at an edge those with a corner in common with an earlier one, the highest of the three:
/// each repeated triangle is counted at one of its edges.
template <class Sides>
std::size_t repeated_at(const TriangleMesh& mesh, Sides first, Sides last) {
  const auto apex = [&](const Side& s) { return mesh.triangles[s.triangle][(s.corner + 2u) % 3]; };
  if (last - first == 2) return apex(first[0]) == apex(first[1]) && apex(first[0]) > first->high;
  std::vector<std::uint32_t> apexes;
  for (auto side = first; side != last; ++side)
    if (apex(*side) > side->high) apexes.push_back(apex(*side));
  std::ranges::sort(apexes);
  return apexes.size() - std::size_t(std::unique(apexes.begin(), apexes.end()) - apexes.begin());
}

void inspect_edges(const TriangleMesh& mesh, const std::vector<Side>& sides, MeshReport& report) {
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first == 1) return note(report.open, *first);
    if (last - first > 2) note(report.crowded, *first);
    if (last - first == 2 && first[0].forward == first[1].forward) note(report.misoriented, *first);
    report.duplicate_count += repeated_at(mesh, first, last);
  });
}

void inspect_triangles(const TriangleMesh& mesh, MeshReport& report) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (a == b || b == c || c == a) {
      ++report.repeated_count;
      if (!report.first_repeated) report.first_repeated = i;
      continue;
    }
    if (projection_axis(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) < 0) ++report.flat_count;
  }
}

void inspect_vertices(const TriangleMesh& mesh, DisjointSets& fans, MeshReport& report) {
  report.equal_vertex_count = equal_vertex_count(mesh.vertices);
  std::vector<std::uint32_t> fan_count(mesh.vertices.size(), 0);
  for (std::uint32_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner)
    if (fans.find(corner) == corner) ++fan_count[mesh.triangles[corner / 3][corner % 3]];
  for (const std::uint32_t count : fan_count) {
    report.unused_vertex_count += count == 0;
    report.pinched_vertex_count += count > 1;
  }
}

/// Tetrahedra against the centre of the box, so that a solid far from the origin keeps its digits.
void inspect_volume(const TriangleMesh& mesh, MeshReport& report) {
  const Box box = bounding_box(mesh);
  const Vec3 centre = box.centre();
  double sum = 0, absolute = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.vertices[a] - centre, q = mesh.vertices[b] - centre, r = mesh.vertices[c] - centre;
    sum += p.dot(q.cross(r));
    absolute += p.norm() * q.norm() * r.norm();
  }
  // Coordinates carry a rounding of their own size, not of the offset from the centre.
  const double size = 0.5 * box.extent().norm();
  const double magnitude = std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff());
  const double amplification = size > 0 ? std::max(1.0, magnitude / size) : 1.0;
  const double roundings = 16.0;  // of one determinant; those of the sum stay random and far below
  report.volume = sum / 6;
  report.negligible_volume =
      roundings * std::numeric_limits<double>::epsilon() * amplification * absolute / 6;
}

std::string edge_text(const TriangleMesh& mesh, const EdgeFault& fault) {
  const Vec3 &a = mesh.vertices[fault.first[0]], &b = mesh.vertices[fault.first[1]];
  return fmt::format("({:.6g}) to ({:.6g})", fmt::join(a, ", "), fmt::join(b, ", "));
}

}  // namespace

MeshReport inspect(const TriangleMesh& mesh) {
  Topology topology(mesh);
  return inspect(mesh, topology);
}

MeshReport inspect(const TriangleMesh& mesh, Topology& topology) {
  MeshReport report;
  inspect_triangles(mesh, report);
  inspect_volume(mesh, report);
  inspect_edges(mesh, topology.sides, report);
  inspect_vertices(mesh, topology.fans, report);
  return report;
}

void require_solid(const TriangleMesh& mesh, std::string_view name) {
  require_solid(mesh, mesh.triangles.empty() ? MeshReport() : inspect(mesh), name);
}

void require_solid(const TriangleMesh& mesh, const MeshReport& r, std::string_view name) {
  if (mesh.triangles.empty())
    throw InputError(fmt::format("{}: no triangles, expected a closed surface", name));
  const auto refuse_edges = [&](const EdgeFault& fault, std::string_view what, std::string_view expected) {
    if (fault.count)
      throw InputError(fmt::format("{}: {}: {}, the first from {}; expected {}", name, what, fault.count,
                                   edge_text(mesh, fault), expected));
  };
  if (r.first_repeated) {
    const Vec3& p = mesh.vertices[mesh.triangles[*r.first_repeated][0]];
    throw InputError(
        fmt::format("{}: degenerate triangles that use a vertex twice: {}, the first is number {} at "
                    "({:.6g}); expected three different vertices each",
                    name, r.repeated_count, *r.first_repeated + 1, fmt::join(p, ", ")));
  }
  refuse_edges(r.crowded, "edges of more than two triangles", "two triangles at every edge");
  refuse_edges(r.open, "open edges", "a watertight mesh, two triangles at every edge");
  refuse_edges(r.misoriented, "edges along which two triangles run the same way",
               "all triangles counter-clockwise seen from outside");
  if (std::abs(r.volume) <= r.negligible_volume)
    throw InputError(fmt::format("{}: encloses no volume, expected a solid", name));
  if (r.volume < 0)
    throw InputError(
        fmt::format("{}: inside out, signed volume {:.6g}; expected triangles counter-clockwise seen from "
                    "outside: reverse "
                    "the order of every triangle's vertices (flip normals)",
                    name, r.volume));
}

}  // namespace kreisel::core
