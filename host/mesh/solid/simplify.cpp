#include "mesh/solid/simplify.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/distance.hpp"
#include "mesh/solid/self_intersections.hpp"
#include "parallel.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

using Index = std::uint32_t;
constexpr Index none = ~Index{0};

/// Sum of squared distances from planes, weighed by the area of what lies in them. [Garland, Heckbert 1997]
class PlaneErrors {
 public:
  void add(const Vec3& at, const Vec3& normal, double area) {
    const double d = -normal.dot(at);
    square_ += area * normal * normal.transpose();
    linear_ += area * d * normal;
    constant_ += area * d * d;
    area_ += area;
  }
  void add(const PlaneErrors& other) {
    square_ += other.square_;
    linear_ += other.linear_;
    constant_ += other.constant_;
    area_ += other.area_;
  }
  /// The mean at p.
  [[nodiscard]] double at(const Vec3& p) const {
    return (p.dot(square_ * p) + 2 * linear_.dot(p) + constant_) / area_;
  }

 private:
  Eigen::Matrix3d square_ = Eigen::Matrix3d::Zero();
  Vec3 linear_ = Vec3::Zero();
  double constant_ = 0, area_ = 0;
};

/// One for equilateral triangles, 0 for those without area.
double roundness(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return edges > 0 ? 2 * std::sqrt(3.0) * normal_of(a, b, c).norm() / edges : 0;
}

class Collapser {
 public:
  /// @param stays  a vertex; outlives the collapser
  Collapser(const TriangleMesh& mesh, const SurfaceTolerance& tolerance,
            const std::vector<std::uint8_t>& stays)
      : vertices_(mesh.vertices),
        triangles_(mesh.triangles),
        tolerance_(tolerance),
        stays_(stays),
        first_corner_(mesh.vertices.size(), none),
        next_corner_(3 * mesh.triangles.size()),
        errors_(mesh.vertices.size()),
        tried_(mesh.vertices.size(), -1),
        first_point_(mesh.triangles.size(), none),
        next_point_(mesh.vertices.size(), none) {
    // About the middle, so that squares keep their digits.
    const Vec3 middle = bounding_box(vertices_).centre();
    for (Vec3& v : vertices_) v -= middle;
    for (Index t = 0; t < triangles_.size(); ++t) {
      const auto& [a, b, c] = triangles_[t];
      const Vec3 n = normal_of(vertices_[a], vertices_[b], vertices_[c]);
      const double twice = n.norm();
      for (Index k = 0; k < 3; ++k) {
        const Index v = triangles_[t][k];
        next_corner_[3 * t + k] = first_corner_[v];
        first_corner_[v] = 3 * t + k;
        if (twice > 0) errors_[v].add(vertices_[a], n / twice, twice / 2);
      }
    }
  }

  /// Tries each vertex once that may do better than the last time. @param most  of the mean squared distance
  /// from its planes, no less than in the pass before  @return  how many went
  std::size_t pass(double most) {
    std::size_t gone = 0;
    for (Index v = 0; v < vertices_.size(); ++v) {
      if (first_corner_[v] == none || stays_[v] || tried_[v] >= most) continue;
      stop_here(v);
      gather(v);
      // The two cheapest ends: what stands against one may not stand against the other.
      std::array<Index, 2> to{none, none};
      std::array<double, 2> cost{most, most};
      for (const Index u : ring_) {
        // In a plane all cost nothing: the nearest then, so that no slivers stand in the way.
        const double here = errors_[v].at(vertices_[u]) + 1e-6 * (vertices_[u] - vertices_[v]).squaredNorm();
        if (here < cost[0]) {
          to = {u, to[0]}, cost = {here, cost[0]};
        } else if (here < cost[1]) {
          to[1] = u, cost[1] = here;
        }
      }
      // The same two will be in the way the next time, unless something moves.
      tried_[v] = to[1] == none ? most : std::numeric_limits<double>::infinity();
      for (const Index u : to)
        if (u != none && may_go(v, u)) {
          collapse(v, u);
          ++gone;
          break;
        }
    }
    return gone;
  }

  /// Says of vertices that they stay: those near these triangles of mesh().
  void hold(const std::vector<Index>& which, std::vector<std::uint8_t>& stays) {
    std::vector<Index> left;
    for (Index t = 0; t < triangles_.size(); ++t)
      if (triangles_[t][0] != none) left.push_back(t);
    for (const Index w : which)
      for (const Index corner : triangles_[left[w]]) {
        gather(corner);
        for (const Index t : around_) {
          for (const Index v : triangles_[t]) stays[v] = 1;
          for (Index p = first_point_[t]; p != none; p = next_point_[p]) stays[p] = 1;
        }
      }
  }

  [[nodiscard]] TriangleMesh mesh(const TriangleMesh& original) const {
    TriangleMesh result;
    std::vector<Index> kept(vertices_.size(), none);
    for (const Triangle& t : triangles_) {
      if (t[0] == none) continue;
      Triangle renamed;
      for (std::size_t k = 0; k < 3; ++k) {
        Index& name = kept[t[k]];
        if (name == none) {
          name = static_cast<Index>(result.vertices.size());
          result.vertices.push_back(original.vertices[t[k]]);
        }
        renamed[k] = name;
      }
      result.triangles.push_back(renamed);
    }
    return result;
  }

 private:
  [[nodiscard]] const Vec3& corner(Index t, std::size_t k) const { return vertices_[triangles_[t][k]]; }

  /// The triangles around v, and its neighbours.
  void gather(Index v) {
    around_.clear();
    ring_.clear();
    for (Index c = first_corner_[v]; c != none; c = next_corner_[c]) {
      const Index t = c / 3, k = c % 3;
      if (triangles_[t][k] != v) continue;  // it went with an edge
      around_.push_back(t);
      ring_.push_back(triangles_[t][(k + 1) % 3]);  // each neighbour follows v in one triangle
    }
  }

  [[nodiscard]] bool has(Index t, Index v) const {
    const Triangle& corners = triangles_[t];
    return corners[0] == v || corners[1] == v || corners[2] == v;
  }

  /// The edge is of two triangles, whose third corners are all that its ends have in common: what is left is
  /// a surface as before. [Dey, Edelsbrunner, Guha, Nekhayev 1999]
  [[nodiscard]] bool keeps_topology(Index v, Index u) const {
    std::size_t common = 0;
    for (Index c = first_corner_[u]; c != none; c = next_corner_[c]) {
      const Index t = c / 3, k = c % 3;
      if (triangles_[t][k] != u) continue;
      const Index beside = triangles_[t][(k + 1) % 3];
      if (beside != v && std::ranges::find(ring_, beside) != ring_.end()) ++common;
    }
    return common == 2 && around_.size() > 3;
  }

  struct Moved {
    Index triangle;
    std::array<Vec3, 3> corners;
    Vec3 normal;
  };

  /// How far from a triangle a point may be. A point on the side of the normals shows that the surface has
  /// moved to the other.
  [[nodiscard]] double allowed(const Moved& t, const Vec3& p) const {
    return (p - t.corners[0]).dot(t.normal) > 0 ? tolerance_.against : tolerance_.along;
  }

  /// Whether a point is as near to a triangle's plane as it must be to the triangle.
  [[nodiscard]] bool near_plane(const Moved& t, const Vec3& p) const {
    const double height = (p - t.corners[0]).dot(t.normal), most = allowed(t, p);
    return height * height <= most * most * t.normal.squaredNorm();
  }

  /// Whether v may be moved to its neighbour u. Leaves in `moved_` what its triangles become, in `homes_`
  /// which of them stand for the points they stood for.
  [[nodiscard]] bool may_go(Index v, Index u) {
    if (!keeps_topology(v, u)) return false;
    moved_.clear();
    for (const Index t : around_) {
      if (has(t, u)) continue;
      Moved now{t, {}, {}};
      for (std::size_t k = 0; k < 3; ++k)
        now.corners[k] = triangles_[t][k] == v ? vertices_[u] : corner(t, k);
      const auto& [a, b, c] = now.corners;
      now.normal = normal_of(a, b, c);
      const Vec3 before = normal_of(corner(t, 0), corner(t, 1), corner(t, 2));
      constexpr double turn = 0.5, sliver = 0.05;
      if (!(now.normal.dot(before) > turn * now.normal.norm() * before.norm())) return false;
      if (const double round = roundness(a, b, c);
          round < sliver && round < roundness(corner(t, 0), corner(t, 1), corner(t, 2)))
        return false;
      moved_.push_back(now);
    }
    homes_.clear();
    if (!find_home(v)) return false;
    for (const Index t : around_)
      for (Index p = first_point_[t]; p != none; p = next_point_[p])
        if (!find_home(p)) return false;
    return true;
  }

  /// Most points stand on a triangle; only for the others distances are worth their while.
  [[nodiscard]] bool find_home(Index point) {
    const Vec3& p = vertices_[point];
    near_.clear();
    for (const Moved& now : moved_) {
      if (!near_plane(now, p)) continue;
      const auto& [a, b, c] = now.corners;
      if (stands_on_triangle(p, a, b, c, now.normal)) {
        homes_.push_back({point, now.triangle});
        return true;
      }
      near_.push_back(&now);
    }
    for (const Moved* now : near_) {
      const auto& [a, b, c] = now->corners;
      if (distance_to_triangle(p, a, b, c) <= allowed(*now, p)) {
        homes_.push_back({point, now->triangle});
        return true;
      }
    }
    return false;
  }

  void collapse(Index v, Index u) {
    for (const Index t : around_) {
      first_point_[t] = none;
      if (has(t, u)) triangles_[t] = {none, none, none};
    }
    for (const auto& [p, t] : homes_) {
      next_point_[p] = first_point_[t];
      first_point_[t] = p;
    }
    for (const Index beside : ring_) tried_[beside] = -1;
    // Corners of v become those of u; the others of both lists have gone.
    Index* tail = &first_corner_[u];
    while (*tail != none) {
      if (triangles_[*tail / 3][*tail % 3] == u)
        tail = &next_corner_[*tail];
      else
        *tail = next_corner_[*tail];
    }
    for (Index c = first_corner_[v]; c != none; c = next_corner_[c])
      if (triangles_[c / 3][c % 3] == v) {
        triangles_[c / 3][c % 3] = u;
        *tail = c;
        tail = &next_corner_[c];
      }
    *tail = none;
    first_corner_[v] = none;
    errors_[u].add(errors_[v]);
  }

  struct Home {
    Index point, triangle;
  };

  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;  ///< none: it has gone
  SurfaceTolerance tolerance_;
  const std::vector<std::uint8_t>& stays_;
  std::vector<Index> first_corner_, next_corner_;  ///< 3 t + k; lists, one a vertex
  std::vector<PlaneErrors> errors_;
  std::vector<double> tried_;  ///< up to which mean a vertex was tried in vain, its triangles as they are
  std::vector<Index> first_point_, next_point_;  ///< vertices that have gone, one list a triangle
  // Of the vertex at hand.
  std::vector<Index> around_, ring_;
  std::vector<Moved> moved_;
  std::vector<const Moved*> near_;
  std::vector<Home> homes_;
};

/// Triangles that run through others, or pass where they may not.
std::vector<Index> faults(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& keeps) {
  std::vector<std::uint8_t> faulty(mesh.triangles.size(), 0);
  for (const auto& pair : self_intersections(mesh))
    for (const Index t : pair) faulty[t] = 1;
  if (keeps)
    parallel_for(faulty.size(), 256, [&](std::size_t t) {
      const auto& [i, j, k] = mesh.triangles[t];
      const auto& [a, b, c] = corners_of(mesh, mesh.triangles[t]);
      // A side is asked about once for both its triangles: whichever is at fault, both are held.
      const auto passes = [&](std::uint32_t from, std::uint32_t to, const Vec3& p, const Vec3& q) {
        return from > to || keeps((p + q) / 2);
      };
      if (!keeps((a + b + c) / 3) || !passes(i, j, a, b) || !passes(j, k, b, c) || !passes(k, i, c, a))
        faulty[t] = 1;
    });
  std::vector<Index> which;
  for (Index t = 0; t < faulty.size(); ++t)
    if (faulty[t]) which.push_back(t);
  return which;
}

}  // namespace

TriangleMesh simplified(const TriangleMesh& mesh, const SurfaceTolerance& tolerance,
                        const std::function<bool(const Vec3&)>& keeps) {
  const double most = std::max(tolerance.along, tolerance.against);
  if (!(most > 0) || mesh.triangles.empty()) return mesh;
  // A chord is off by an eighth of its square in the curvature, a vertex from its neighbour's plane by half
  // of it.
  const double planes = std::pow(4 * most, 2);
  const std::size_t few = mesh.vertices.size() / 100;
  std::vector<std::uint8_t> stays(mesh.vertices.size(), 0);
  constexpr int most_tries = 4;
  for (int tries = 0; tries < most_tries; ++tries) {
    const std::vector<std::uint8_t> held = stays;
    Collapser collapser(mesh, tolerance, held);
    for (const double share : {1.0 / 256, 1.0 / 64, 1.0 / 16, 1.0 / 4, 1.0}) collapser.pass(share * planes);
    while (collapser.pass(planes) > few) {
    }
    TriangleMesh result = collapser.mesh(mesh);
    const std::vector<Index> faulty = faults(result, keeps);
    if (faulty.empty()) return result;
    collapser.hold(faulty, stays);
  }
  return mesh;
}

}  // namespace kreisel::core
