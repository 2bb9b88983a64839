#include "mesh/solid/components.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/predicates.hpp"
#include "geometry/triangle.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

/// Number of each triangle's shell, from 0 in order of first triangles.
std::vector<std::uint32_t> label(const TriangleMesh& mesh, const std::vector<Side>& sides,
                                 std::size_t& count) {
  DisjointSets sets(mesh.triangles.size());
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first == 2) sets.join(first[0].triangle, first[1].triangle);
  });
  std::vector<std::uint32_t> labels(mesh.triangles.size());
  count = 0;
  for (std::uint32_t t = 0; t < labels.size(); ++t)
    labels[t] = sets.find(t) == t ? std::uint32_t(count++) : labels[sets.find(t)];
  return labels;
}

void measure(const TriangleMesh& mesh, Shell& shell) {
  const auto corner = [&](std::uint32_t t, std::size_t k) -> const Vec3& {
    return mesh.vertices[mesh.triangles[t][k]];
  };
  for (const std::uint32_t t : shell.triangles)
    for (std::size_t k = 0; k < 3; ++k) shell.box.add(corner(t, k));
  const Vec3 centre = shell.box.centre();  // far from the origin digits would cancel
  for (const std::uint32_t t : shell.triangles)
    shell.volume += (corner(t, 0) - centre).dot((corner(t, 1) - centre).cross(corner(t, 2) - centre)) / 6;
}

/// Does a ray in direction +z from p cross the triangle? p counts as moved a little towards +x and still less
/// towards +y, so that a ray through an edge crosses exactly one of the two triangles there.
bool crosses(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec2 q = drop(p, 2);
  const std::array<const Vec3*, 3> corner{&a, &b, &c};
  int winding = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = *corner[k], &to = *corner[(k + 1) % 3];
    const bool from_below = from.y() <= p.y(), to_below = to.y() <= p.y();
    if (from_below == to_below) continue;
    const int side = orient2d(drop(from, 2), drop(to, 2), q);
    if (from_below && side > 0) ++winding;
    if (to_below && side < 0) --winding;
  }
  return winding != 0 && orient3d(a, b, c, p) * winding < 0;
}

bool encloses(const TriangleMesh& mesh, const Shell& shell, const Vec3& p) {
  bool inside = false;
  for (const std::uint32_t t : shell.triangles) {
    stop_here();
    const auto [a, b, c] = corners_of(mesh, mesh.triangles[t]);
    if (std::max({a.y(), b.y(), c.y()}) < p.y() || std::min({a.y(), b.y(), c.y()}) > p.y()) continue;
    if (std::max({a.x(), b.x(), c.x()}) < p.x() || std::max({a.z(), b.z(), c.z()}) < p.z()) continue;
    if (crosses(p, a, b, c)) inside = !inside;
  }
  return inside;
}

/// The middle of the largest triangle: a point that no other shell touches, where shells only touch at edges.
Vec3 point_of(const TriangleMesh& mesh, const Shell& shell) {
  const auto size = [&](std::uint32_t t) { return normal_of(mesh, mesh.triangles[t]).squaredNorm(); };
  return middle_of(mesh, mesh.triangles[*std::ranges::max_element(shell.triangles, {}, size)]);
}

}  // namespace

std::vector<Shell> shells(const TriangleMesh& mesh) {
  Topology topology(mesh);
  return shells(mesh, topology);
}

std::vector<Shell> shells(const TriangleMesh& mesh, Topology& topology) {
  auto& [sides, fans] = topology;
  std::size_t count = 0;
  const std::vector<std::uint32_t> labels = label(mesh, sides, count);
  std::vector<Shell> result(count);
  std::vector<std::size_t> sizes(count, 0);
  for (const std::uint32_t label : labels) ++sizes[label];
  for (std::size_t i = 0; i < count; ++i) result[i].triangles.reserve(sizes[i]);
  for (std::uint32_t t = 0; t < labels.size(); ++t) result[labels[t]].triangles.push_back(t);

  for (Shell& shell : result) shell.euler = long(shell.triangles.size());
  for_each_edge(sides, [&](auto first, auto last) {
    if (last - first == 2) {
      Shell& shell = result[labels[first->triangle]];
      --shell.euler;
      if (first[0].forward == first[1].forward) shell.oriented = false;
    } else {
      for (auto side = first; side != last; ++side) {
        --result[labels[side->triangle]].euler;
        result[labels[side->triangle]].closed = false;
      }
    }
  });
  for (std::uint32_t corner = 0; corner < 3 * labels.size(); ++corner)
    if (fans.find(corner) == corner) ++result[labels[corner / 3]].euler;
  for (Shell& shell : result) {
    measure(mesh, shell);
    if (shell.closed && shell.oriented) shell.genus = (2 - shell.euler) / 2;
  }
  return result;
}

std::vector<std::vector<std::uint32_t>> enclosing_shells(const TriangleMesh& mesh,
                                                         const std::vector<Shell>& shells) {
  std::vector<std::vector<std::uint32_t>> enclosing(shells.size());
  for (std::size_t i = 0; i < shells.size(); ++i) {
    stop_here();
    const Vec3 p = point_of(mesh, shells[i]);
    for (std::uint32_t j = 0; j < shells.size(); ++j)
      if (i != j && shells[i].box.within(shells[j].box) && encloses(mesh, shells[j], p))
        enclosing[i].push_back(j);
  }
  return enclosing;
}

}  // namespace kreisel::core
