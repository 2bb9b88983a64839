#include "mesh/check.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "error.hpp"

namespace kreisel {
namespace {

/// One side of a triangle; `forward` when it runs from the lower to the higher vertex index.
struct Side {
  std::uint32_t low, high;
  bool forward;
  [[nodiscard]] bool same_edge(const Side& o) const { return low == o.low && high == o.high; }
};

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      if (from != to) sides.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  return sides;
}

void note(EdgeFault& fault, const Side& side) {
  if (!fault.count++) fault.first = {side.low, side.high};
}

void inspect_edges(const TriangleMesh& mesh, MeshReport& report) {
  const std::vector<Side> sides = sorted_sides(mesh);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const Side& s) { return !s.same_edge(*first); });
    if (last - first == 1) note(report.open, *first);
    if (last - first > 2) note(report.crowded, *first);
    if (last - first == 2 && first[0].forward == first[1].forward) note(report.misoriented, *first);
    first = last;
  }
}

/// Tetrahedra against the centre of the box, so that a solid far from the origin keeps its digits.
void inspect_volume(const TriangleMesh& mesh, MeshReport& report) {
  const Box box = bounding_box(mesh);
  const Vec3 centre = 0.5 * (box.lo + box.hi);
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
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", a.x(), a.y(), a.z(), b.x(),
                     b.y(), b.z());
}

}  // namespace

MeshReport inspect(const TriangleMesh& mesh) {
  MeshReport report;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (a != b && b != c && c != a) continue;
    ++report.repeated_count;
    if (!report.first_repeated) report.first_repeated = i;
  }
  inspect_edges(mesh, report);
  inspect_volume(mesh, report);
  return report;
}

void require_solid(const TriangleMesh& mesh, std::string_view name) {
  if (mesh.triangles.empty())
    throw InputError(fmt::format("{}: no triangles, expected a closed surface", name));
  const MeshReport r = inspect(mesh);
  const auto refuse_edges = [&](const EdgeFault& fault, std::string_view what, std::string_view expected) {
    if (fault.count)
      throw InputError(fmt::format("{}: {}: {}, the first from {}; expected {}", name, what, fault.count,
                                   edge_text(mesh, fault), expected));
  };
  if (r.first_repeated) {
    const Vec3& p = mesh.vertices[mesh.triangles[*r.first_repeated][0]];
    throw InputError(
        fmt::format("{}: degenerate triangles that use a vertex twice: {}, the first is number {} at "
                    "({:.6g}, {:.6g}, {:.6g}); "
                    "expected three different vertices each",
                    name, r.repeated_count, *r.first_repeated + 1, p.x(), p.y(), p.z()));
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

}  // namespace kreisel
