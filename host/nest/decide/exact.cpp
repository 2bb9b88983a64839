#include "nest/decide/exact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "mesh/query/sides.hpp"
#include "nest/decide/swept_pair.hpp"
#include "parallel.hpp"

namespace kreisel::core::nest {
namespace {

/// A triangle in a half's coordinates.
struct Seen {
  std::array<Vec3, 3> corner;
  Box box;
};

/// The triangles of a mesh with a point beyond the cut or on it. @param index  of each in the mesh
template <class Map>
std::vector<Seen> seen_of(const TriangleMesh& mesh, const HalfView& frame, const Map& map) {
  std::vector<Vec3> at(mesh.vertices.size());
  std::vector<double> beyond(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = frame.into(map(mesh.vertices[i]));
    beyond[i] = frame.cut.above(at[i]);
  }
  std::vector<Seen> seen;
  for (const Triangle& t : mesh.triangles) {
    if (beyond[t[0]] < 0 && beyond[t[1]] < 0 && beyond[t[2]] < 0) continue;
    const std::array<Vec3, 3> corner = {at[t[0]], at[t[1]], at[t[2]]};
    seen.push_back({corner, bounding_box(corner)});
  }
  return seen;
}

/// Triangles of A by the cells they reach, across the removal direction.
class Cells {
 public:
  Cells(const std::vector<Seen>& a, const std::vector<Seen>& b) : a_(&a) {
    for (const Seen& t : b) box_.add(t.box.lo), box_.add(t.box.hi);
    n_ = std::clamp(int(std::sqrt(double(b.size()))), 1, 1024);
    size_ = std::max({box_.extent()[0], box_.extent()[1], 1e-9}) / n_;
    std::vector<std::uint32_t> count(std::size_t(n_) * std::size_t(n_) + 1);
    const auto each = [&](auto&& visit) {
      for (std::uint32_t i = 0; i < a.size(); ++i)
        if (in_the_way(a[i].box, box_)) for_each_cell(a[i], [&](std::size_t cell) { visit(cell, i); });
    };
    each([&](std::size_t cell, std::uint32_t) { ++count[cell + 1]; });
    for (std::size_t c = 1; c < count.size(); ++c) count[c] += count[c - 1];
    first_ = count;
    triangles_.resize(count.back());
    each([&](std::size_t cell, std::uint32_t i) { triangles_[count[cell]++] = i; });
  }

  /// Calls visit(triangle of A) once for each that may meet what t sweeps, until one returns true.
  template <class Visit>
  bool any(const Seen& t, Visit&& visit) const {
    const auto& [lo, hi] = t.box;
    const int x0 = cell(lo, 0), x1 = cell(hi, 0), y0 = cell(lo, 1), y1 = cell(hi, 1);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const std::size_t at = std::size_t(y) * std::size_t(n_) + std::size_t(x);
        for (std::uint32_t k = first_[at]; k < first_[at + 1]; ++k) {
          const Seen& u = (*a_)[triangles_[k]];
          if (!in_the_way(u.box, t.box)) continue;
          // Only in the first cell that both reach.
          if (std::max(x0, cell(u.box.lo, 0)) != x || std::max(y0, cell(u.box.lo, 1)) != y) continue;
          if (visit(u)) return true;
        }
      }
    return false;
  }

 private:
  /// Whether boxes overlap, seen along the direction, and that of A does not begin beyond the other.
  [[nodiscard]] static bool in_the_way(const Box& a, const Box& b) {
    return a.lo[2] <= b.hi[2] && a.lo[0] <= b.hi[0] && a.hi[0] >= b.lo[0] && a.lo[1] <= b.hi[1] &&
           a.hi[1] >= b.lo[1];
  }
  [[nodiscard]] int cell(const Vec3& p, int axis) const {
    return int(std::clamp((p[axis] - box_.lo[axis]) / size_, 0.0, double(n_ - 1)));
  }
  template <class Visit>
  void for_each_cell(const Seen& u, Visit&& visit) const {
    for (int y = cell(u.box.lo, 1); y <= cell(u.box.hi, 1); ++y)
      for (int x = cell(u.box.lo, 0); x <= cell(u.box.hi, 0); ++x)
        visit(std::size_t(y) * std::size_t(n_) + std::size_t(x));
  }

  const std::vector<Seen>* a_;
  Box box_;  ///< of b
  double size_;
  int n_;
  std::vector<std::uint32_t> first_, triangles_;
};

/// A point of A's surface that the sweep of T(B) meets in this half, and the triangle of `b` above it.
std::optional<std::pair<std::size_t, Vec3>> first_meeting(const std::vector<Seen>& a,
                                                          const std::vector<Seen>& b, const HalfView& frame) {
  if (a.empty() || b.empty()) return std::nullopt;
  const Cells cells(a, b);
  constexpr std::size_t chunk = 256;
  std::atomic<std::size_t> first = b.size();  // chunks before it are still looked at, so the lowest is found
  std::vector<Vec3> where((b.size() + chunk - 1) / chunk);
  parallel_for(where.size(), [&](std::size_t c) {
    for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, b.size()) && i < first; ++i) {
      const SweptTriangle swept(frame, b[i].corner[0], b[i].corner[1], b[i].corner[2]);
      if (swept.edge_on()) continue;
      const bool met = cells.any(b[i], [&](const Seen& u) {
        const auto point = swept.common_point(u.corner[0], u.corner[1], u.corner[2]);
        if (point) where[c] = *point;
        return point.has_value();
      });
      if (!met) continue;
      std::size_t known = first;
      while (i < known && !first.compare_exchange_weak(known, i)) {
      }
      return;
    }
  });
  if (first == b.size()) return std::nullopt;
  return std::pair{std::size_t(first), where[first / chunk]};
}

}  // namespace

double winding_number(const TriangleMesh& mesh, const Vec3& point) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - point, b = mesh.vertices[t[1]] - point,
               c = mesh.vertices[t[2]] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

std::vector<std::uint32_t> vertex_of_each_shell(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  }
  std::vector<std::uint32_t> found;
  for (const Triangle& t : mesh.triangles) found.push_back(sets.find(t[0]));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Exact::Exact(const Nesting& nesting) : nesting_(&nesting), shells_(vertex_of_each_shell(nesting.inner())) {}

Verdict Exact::check(const Placement& placement) {
  require_valid(placement);
  const auto map = [&](const Vec3& x) -> Vec3 {
    return placement.pose.scale * (placement.pose.rotation * x) + placement.pose.centroid;
  };
  for (int half = 0; half < 2; ++half) {
    const HalfView frame = view_of(placement.cut, half);
    const auto a = seen_of(nesting_->outer(), frame, [](const Vec3& x) -> Vec3 { return x; });
    const auto b = seen_of(nesting_->inner(), frame, map);
    if (const auto met = first_meeting(a, b, frame)) {
      const auto& [t, x] = *met;
      const SweptTriangle swept(frame, b[t].corner[0], b[t].corner[1], b[t].corner[2]);
      return {Fault::swept, half, frame.out_of(swept.top(x))};
    }
  }
  for (const std::uint32_t vertex : shells_) {
    const Vec3 point = map(nesting_->inner().vertices[vertex]);
    if (winding_number(nesting_->outer(), point) < 0.5)
      return {Fault::outside, placement.cut.beyond(0, point) >= 0 ? 0 : 1, point};
  }
  return {};
}

}  // namespace kreisel::core::nest
