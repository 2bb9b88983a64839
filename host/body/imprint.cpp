#include "body/imprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace kreisel::core {
namespace {

using Index = std::uint32_t;

std::uint64_t edge_key(Index a, Index b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::uint64_t{std::max(a, b)};
}

/// A line of the polygon: n . p - d is negative inside.
struct Side {
  Vec2 n;
  double d;
  [[nodiscard]] double at(const Vec3& p) const { return n.dot(p.head<2>()) - d; }
};

struct Piece {
  Triangle corners;
  bool near;  ///< of a triangle near the prism: its edges are cut; others only share them
};

class Cutter {
 public:
  Cutter(const TriangleMesh& mesh, const Polygon& polygon) : vertices_(mesh.vertices) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const Vec2 along = (b - a).normalized(), n(along[1], -along[0]);
      sides_.push_back({n, n.dot(a)});
    }
    gather(mesh, polygon);
  }

  [[nodiscard]] Imprint run() {
    for (std::size_t k = 0; k < sides_.size(); ++k) cut(k);
    Imprint result;
    result.shortest = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces_) {
      if (piece.near && is_inside(piece.corners)) result.inside.push_back(static_cast<Index>(far_.size()));
      far_.push_back(piece.corners);
      for (std::size_t k = 0; k < 3; ++k) {
        const Index a = piece.corners[k], b = piece.corners[(k + 1) % 3];
        if (std::max(a, b) >= first_new_)
          result.shortest = std::min(result.shortest, (vertices_[a] - vertices_[b]).norm());
      }
    }
    result.mesh = {std::move(vertices_), std::move(far_)};
    return result;
  }

 private:
  /// Parts the triangles into those near the prism, those that share an edge with them, and the others.
  void gather(const TriangleMesh& mesh, const Polygon& polygon) {
    Vec2 lo = polygon.front(), hi = polygon.front();
    for (const Vec2& p : polygon) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
    std::vector<bool> near(mesh.triangles.size());
    std::unordered_set<std::uint64_t> edges;
    for (std::size_t i = 0; i < near.size(); ++i) {
      const Triangle& t = mesh.triangles[i];
      const auto at = [&](std::size_t k) -> Vec2 { return mesh.vertices[t[k]].head<2>(); };
      const Vec2 low = at(0).cwiseMin(at(1)).cwiseMin(at(2)), high = at(0).cwiseMax(at(1)).cwiseMax(at(2));
      near[i] = (low.array() <= hi.array()).all() && (high.array() >= lo.array()).all();
      if (!near[i]) continue;
      for (std::size_t k = 0; k < 3; ++k) edges.insert(edge_key(t[k], t[(k + 1) % 3]));
    }
    for (std::size_t i = 0; i < near.size(); ++i) {
      const Triangle& t = mesh.triangles[i];
      const bool beside = edges.contains(edge_key(t[0], t[1])) || edges.contains(edge_key(t[1], t[2])) ||
                          edges.contains(edge_key(t[2], t[0]));
      if (near[i] || beside)
        pieces_.push_back({t, near[i]});
      else
        far_.push_back(t);
    }
    first_new_ = static_cast<Index>(vertices_.size());
    for (const Piece& piece : pieces_)
      for (const Index v : piece.corners) {
        std::vector<std::int8_t>& signs = signs_[v];
        if (signs.empty())
          for (const Side& side : sides_) signs.push_back(side.at(vertices_[v]) > 0 ? 1 : -1);
      }
  }

  /// Whether the edge crosses line k and is not beyond an earlier one altogether.
  [[nodiscard]] bool to_cut(Index a, Index b, std::size_t k) const {
    const auto &u = signs_.at(a), &v = signs_.at(b);
    if (u[k] * v[k] >= 0) return false;
    for (std::size_t j = 0; j < k; ++j)
      if (u[j] >= 0 && v[j] >= 0 && u[j] + v[j] > 0) return false;
    return true;
  }

  Index point_on(Index a, Index b, std::size_t k) {
    const auto [entry, is_new] = cuts_.try_emplace(edge_key(a, b), static_cast<Index>(vertices_.size()));
    if (!is_new) return entry->second;
    if (a > b) std::swap(a, b);
    const double at_a = sides_[k].at(vertices_[a]), at_b = sides_[k].at(vertices_[b]);
    const Vec3 p = vertices_[a] + at_a / (at_a - at_b) * (vertices_[b] - vertices_[a]);
    std::vector<std::int8_t> signs(sides_.size(), 0);
    const auto &u = signs_.at(a), &v = signs_.at(b);
    for (std::size_t j = 0; j < sides_.size(); ++j) {
      if (j < k) signs[j] = u[j] != 0 ? u[j] : v[j];
      if (j > k) signs[j] = u[j] == v[j] ? u[j] : std::int8_t(sides_[j].at(p) > 0 ? 1 : -1);
      if (j < k && u[j] == 0 && v[j] == 0) signs[j] = 0;
    }
    vertices_.push_back(p);
    signs_[entry->second] = std::move(signs);
    return entry->second;
  }

  void cut(std::size_t k) {
    cuts_.clear();
    for (const Piece& piece : pieces_)
      if (piece.near)
        for (std::size_t e = 0; e < 3; ++e)
          if (const Index a = piece.corners[e], b = piece.corners[(e + 1) % 3]; to_cut(a, b, k))
            (void)point_on(a, b, k);
    if (cuts_.empty()) return;
    std::vector<Piece> next;
    for (const Piece& piece : pieces_) part(piece, next);
    pieces_ = std::move(next);
  }

  /// One piece along the points on its edges.
  void part(const Piece& piece, std::vector<Piece>& next) const {
    constexpr Index none = ~Index{0};
    std::array<Index, 3> on{none, none, none};
    std::size_t count = 0, whole = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      const auto found = cuts_.find(edge_key(piece.corners[e], piece.corners[(e + 1) % 3]));
      if (found != cuts_.end())
        on[e] = found->second, ++count;
      else
        whole = e;
    }
    if (count == 0) {
      next.push_back(piece);
      return;
    }
    if (count == 1) {
      const std::size_t e = on[0] != none ? 0 : on[1] != none ? 1 : 2;
      const Index a = piece.corners[e], b = piece.corners[(e + 1) % 3], c = piece.corners[(e + 2) % 3];
      next.push_back({{a, on[e], c}, piece.near});
      next.push_back({{on[e], b, c}, piece.near});
      return;
    }
    // The uncut edge runs from a to b, the tip c is cut off.
    const Index a = piece.corners[whole], b = piece.corners[(whole + 1) % 3],
                c = piece.corners[(whole + 2) % 3], bc = on[(whole + 1) % 3], ca = on[(whole + 2) % 3];
    next.push_back({{bc, c, ca}, piece.near});
    // Of a quadrilateral's two diagonals the shorter.
    if ((vertices_[a] - vertices_[bc]).squaredNorm() < (vertices_[b] - vertices_[ca]).squaredNorm()) {
      next.push_back({{a, b, bc}, piece.near});
      next.push_back({{a, bc, ca}, piece.near});
    } else {
      next.push_back({{a, b, ca}, piece.near});
      next.push_back({{b, bc, ca}, piece.near});
    }
  }

  [[nodiscard]] bool is_inside(const Triangle& t) const {
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      int most = -1, least = 1;
      for (const Index v : t) {
        most = std::max<int>(most, signs_.at(v)[k]);
        least = std::min<int>(least, signs_.at(v)[k]);
      }
      if (most > 0 || least == 0) return false;
    }
    return true;
  }

  std::vector<Vec3> vertices_;
  std::vector<Side> sides_;
  std::vector<Piece> pieces_;
  std::vector<Triangle> far_;
  Index first_new_ = 0;
  std::unordered_map<Index, std::vector<std::int8_t>> signs_;
  std::unordered_map<std::uint64_t, Index> cuts_;
};

}  // namespace

Imprint imprint(const TriangleMesh& mesh, const Polygon& polygon) { return Cutter(mesh, polygon).run(); }

}  // namespace kreisel::core
