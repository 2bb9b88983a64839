#include "mesh/solid/unite.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/moved.hpp"
#include "geometry/single_precision.hpp"
#include "geometry/triangle.hpp"
#include "mesh/query/equal_vertices.hpp"
#include "mesh/solid/repair.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "mesh/solid/winding.hpp"

namespace kreisel::core {
namespace {

constexpr int most_rounds = 4;

/// More pairs of triangles than this are no surface that somebody made: each triangle would fall into
/// hundreds.
std::size_t tangled(const TriangleMesh& mesh) { return 1000 + 20 * mesh.triangles.size(); }

bool is_solid(int winding, InsideOut inside_out) {
  return winding >= 1 || (winding <= -1 && inside_out == InsideOut::solid);
}

/// Volume of the cone from a place to the face.
double cone(const Arrangement& all, std::uint32_t face, const Vec3& apex) {
  const auto& [a, b, c] = all.faces[face];
  return (all.points.near(a) - apex).dot((all.points.near(b) - apex).cross(all.points.near(c) - apex)) / 6;
}

void measure(const Arrangement& all, const std::vector<PatchSides>& sides, United& made) {
  const Vec3 apex = all.points.near(all.faces[0][0]);
  for (std::uint32_t f = 0; f < all.faces.size(); ++f) {
    const auto& [front, back, repeated] = sides[f];
    if (repeated || front >= back) continue;  // told by another, or by those on its other side
    const double volume = cone(all, f, apex);
    made.overlap += volume * std::max(0, back - std::max(front, 1));
    if (front < 0) {
      made.inside_out -= volume * (std::min(back, 0) - front);
      made.inside_out_at = all.points.near(all.faces[f][0]);
    }
  }
}

/// The coordinates are of single precision, as those of an STL file.
bool in_single(const TriangleMesh& mesh) {
  return std::ranges::all_of(mesh.vertices, [](const Vec3& v) { return in_single_precision(v) == v; });
}

/// How points that no vertex is at become ones.
struct Rounding {
  bool to_single;
  double step;  ///< to a multiple of it; 0: to the nearest number there is

  [[nodiscard]] Vec3 operator()(const ExactPoint& p) const {
    if (step > 0) return (p.near() / step).array().round() * step;
    return p.rounded(to_single);
  }
};

/// The finest first. Where a great many points lie within the last digits of each other, as where a surface
/// of revolution meets its axis, only a coarse one makes one of them.
std::vector<Rounding> roundings(const TriangleMesh& mesh) {
  const bool to_single = in_single(mesh);
  const Box box = bounding_box(mesh);
  const double size = box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).maxCoeff();
  const int digits = to_single ? 24 : 53, coarsest = 20;  // a millionth of the mesh
  std::vector<Rounding> all{{to_single, 0}};
  for (int kept = digits - 3; kept >= coarsest; kept -= to_single ? 1 : 6)
    all.push_back({to_single, std::ldexp(1, std::ilogb(size) + 1 - kept)});
  return all;
}

/// The faces with solid behind and none in front, as they are or turned.
std::vector<Triangle> boundary(const Arrangement& all, const std::vector<PatchSides>& sides,
                               InsideOut inside_out) {
  std::vector<Triangle> kept;
  for (std::uint32_t f = 0; f < all.faces.size(); ++f) {
    const auto& [front, back, repeated] = sides[f];
    if (repeated || front >= back) continue;
    const bool before = is_solid(front, inside_out), behind = is_solid(back, inside_out);
    if (before == behind) continue;
    const auto& [a, b, c] = all.faces[f];
    kept.push_back(behind ? Triangle{a, b, c} : Triangle{a, c, b});
  }
  return kept;
}

/// Triangles that lie on each other the opposite way round have nothing between them: both go.
void cancel_opposites(std::vector<Triangle>& triangles) {
  const auto turned_to_lowest = [](Triangle t) {
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
    return t;
  };
  std::map<Triangle, int> count;
  for (Triangle& t : triangles) ++count[t = turned_to_lowest(t)];
  std::erase_if(triangles, [&](const Triangle& t) {
    const auto opposite = count.find({t[0], t[2], t[1]});
    if (opposite == count.end() || opposite->second == 0) return false;
    int& own = count[t];
    if (own > opposite->second) return --own, false;
    return true;
  });
}

/// Triangles by number of their points as a mesh, whose points are rounded.
TriangleMesh rounded(const TriangleMesh& mesh, const PointSet& points, std::vector<Triangle> triangles,
                     const Rounding& rounding) {
  TriangleMesh made{mesh.vertices, std::move(triangles)};
  for (auto p = std::uint32_t(mesh.vertices.size()); p < points.size(); ++p)
    made.vertices.push_back(rounding(points[p]));
  const std::vector<std::uint32_t> place = first_equal_vertex(made.vertices);
  for (Triangle& t : made.triangles)
    for (std::uint32_t& v : t) v = place[v];
  std::erase_if(made.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  cancel_opposites(made.triangles);
  RepairReport unsaid;
  return repaired(std::move(made), unsaid);
}

/// A mesh with the pairs of its triangles that meet.
struct Met {
  TriangleMesh mesh;
  std::vector<std::array<std::uint32_t, 2>> crossings;
};

/// The first rounding that lets no triangles meet, else that of the fewest.
Met best_rounded(const TriangleMesh& mesh, const PointSet& points, const std::vector<Triangle>& triangles) {
  Met best;
  for (const Rounding& rounding : roundings(mesh)) {
    TriangleMesh candidate = rounded(mesh, points, triangles, rounding);
    auto crossings = self_intersections(candidate);
    if (candidate.triangles.empty() ||
        (!best.mesh.triangles.empty() && crossings.size() >= best.crossings.size()))
      continue;
    best = {std::move(candidate), std::move(crossings)};
    if (best.crossings.empty()) break;
  }
  return best;
}

std::size_t shared_triangles(const TriangleMesh& before, const TriangleMesh& after) {
  using Corners = std::array<std::array<double, 3>, 3>;
  const auto corners = [](const TriangleMesh& mesh, const Triangle& t) {
    Corners c;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& v = mesh.vertices[t[k]];
      c[k] = {v[0], v[1], v[2]};
    }
    std::ranges::sort(c);
    return c;
  };
  std::vector<Corners> old;
  for (const Triangle& t : before.triangles) old.push_back(corners(before, t));
  std::ranges::sort(old);
  return std::size_t(std::ranges::count_if(after.triangles, [&](const Triangle& t) {
    return std::ranges::binary_search(old, corners(after, t));
  }));
}

}  // namespace

std::optional<United> unite(const TriangleMesh& mesh, InsideOut inside_out) {
  United made;
  Met now{mesh, self_intersections(mesh)};
  for (int round = 0; round == 0 || (round < most_rounds && !now.crossings.empty()); ++round) {
    if (now.crossings.size() > tangled(now.mesh)) return {};
    const Arrangement all = arrange(now.mesh, now.crossings);
    if (all.faces.empty() || !all.closed) return {};
    const std::vector<PatchSides> sides = winding(now.mesh, all);
    if (round == 0) {
      const auto most = std::ranges::max(sides, {}, &PatchSides::back).back;
      const auto least = std::ranges::min(sides, {}, &PatchSides::front).front;
      if (most <= 0 && least < 0) {
        auto turned = unite(turned_over(mesh), inside_out);
        if (turned) turned->turned = true;
        return turned;
      }
      measure(all, sides, made);
    }
    now = best_rounded(now.mesh, all.points, boundary(all, sides, inside_out));
  }
  made.kept = shared_triangles(mesh, now.mesh);
  made.mesh = std::move(now.mesh);
  return made;
}

}  // namespace kreisel::core
