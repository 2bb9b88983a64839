#include "geometry/triangulation.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "stop.hpp"

namespace kreisel::core {
namespace {

constexpr std::uint32_t none = ~0u;

/// Clearly within the circle through a, b and c, which run counter-clockwise: up to rounding.
bool in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 u = a - d, v = b - d, w = c - d;
  const double x = u.squaredNorm(), y = v.squaredNorm(), z = w.squaredNorm();
  const double det = x * cross(v, w) + y * cross(w, u) + z * cross(u, v);
  return det > 1e-9 * (x * v.norm() * w.norm() + y * w.norm() * u.norm() + z * u.norm() * v.norm());
}

}  // namespace

Triangulation::Triangulation(const ExactPlane& plane, const Triangle& whole) : plane_(plane) { add(whole); }

/// The triangle left of the edge from a to b, none outside.
std::uint32_t Triangulation::beside(std::uint32_t a, std::uint32_t b) const {
  const auto found = left_of_.find(key(a, b));
  return found == left_of_.end() ? none : found->second;
}

/// Its third corner.
std::uint32_t Triangulation::apex(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t t = beside(a, b);
  if (t == none) return none;
  for (const std::uint32_t v : triangles_[t])
    if (v != a && v != b) return v;
  return none;
}

void Triangulation::set(std::uint32_t t, const Triangle& triangle) {
  triangles_[t] = triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    left_of_[key(triangle[k], triangle[(k + 1) % 3])] = t;
    at_[triangle[k]] = t;
  }
}

std::uint32_t Triangulation::add(const Triangle& triangle) {
  triangles_.push_back(triangle);
  const auto t = std::uint32_t(triangles_.size() - 1);
  set(t, triangle);
  return t;
}

/// The triangle with the point in it: by a walk from the newest one, towards it; should that go in circles,
/// by looking at all.
std::uint32_t Triangulation::locate(std::uint32_t p) const {
  const auto out_by = [&](std::uint32_t t) {
    for (std::size_t k = 0; k < 3; ++k)
      if (plane_.orient(triangles_[t][k], triangles_[t][(k + 1) % 3], p) < 0) return k;
    return std::size_t{3};
  };
  auto t = std::uint32_t(triangles_.size() - 1);
  for (std::size_t steps = 0; steps < triangles_.size(); ++steps) {
    const std::size_t k = out_by(t);
    if (k == 3) return t;
    t = beside(triangles_[t][(k + 1) % 3], triangles_[t][k]);
    if (t == none) break;
  }
  for (t = 0; t + 1 < triangles_.size() && out_by(t) != 3; ++t) {
  }
  return t;
}

void Triangulation::insert(std::uint32_t p) {
  stop_here();
  const std::uint32_t t = locate(p);
  const auto [a, b, c] = triangles_[t];
  const std::array<Edge, 3> sides{Edge{a, b}, Edge{b, c}, Edge{c, a}};
  for (const auto& [from, to] : sides) {
    if (plane_.orient(from, to, p) != 0) continue;
    // On an edge: two triangles become four, one two.
    const std::uint32_t near = apex(from, to), far = apex(to, from), across = beside(to, from);
    left_of_.erase(key(from, to));
    left_of_.erase(key(to, from));
    set(t, {p, to, near});
    add({from, p, near});
    if (across != none) {
      set(across, {p, from, far});
      add({to, p, far});
      settle({{to, near}, {near, from}, {from, far}, {far, to}});
    } else {
      settle({{to, near}, {near, from}});
    }
    return;
  }
  set(t, {a, b, p});
  add({b, c, p});
  add({c, a, p});
  settle({sides.begin(), sides.end()});
}

/// Whether the two triangles at the edge make a quadrilateral whose other diagonal lies within.
bool Triangulation::can_turn(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t c = apex(a, b), d = apex(b, a);
  return c != none && d != none && plane_.orient(c, d, b) > 0 && plane_.orient(d, c, a) > 0;
}

bool Triangulation::should_turn(std::uint32_t a, std::uint32_t b) const {
  const std::uint32_t c = apex(a, b), d = apex(b, a);
  return c != none && d != none &&
         in_circle(plane_.near(a), plane_.near(b), plane_.near(c), plane_.near(d)) && can_turn(a, b);
}

/// Puts the other diagonal in place of the edge. @return  it
Triangulation::Edge Triangulation::turn(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t t = beside(a, b), u = beside(b, a), c = apex(a, b), d = apex(b, a);
  left_of_.erase(key(a, b));
  left_of_.erase(key(b, a));
  set(t, {a, d, c});
  set(u, {d, b, c});
  return {c, d};
}

/// Turns what should be, of these edges and of those that it puts beside others. Rounding might have it go in
/// circles: then it stops.
void Triangulation::settle(std::vector<Edge> edges) {
  for (std::size_t steps = 64 + 8 * edges.size() + triangles_.size(); steps > 0 && !edges.empty(); --steps) {
    const auto [a, b] = edges.back();
    edges.pop_back();
    if (fixed_.contains(key(std::min(a, b), std::max(a, b))) || !should_turn(a, b)) continue;
    const auto [c, d] = turn(a, b);
    for (const Edge& edge : {Edge{a, d}, Edge{d, b}, Edge{b, c}, Edge{c, a}}) edges.push_back(edge);
  }
}

/// The edge, opposite of a in one of its triangles, that the segment from a to b passes first.
Triangulation::Edge Triangulation::first_between(std::uint32_t a, std::uint32_t b) const {
  const auto passes = [&](std::uint32_t from, std::uint32_t to) {
    return plane_.orient(a, b, from) < 0 && plane_.orient(a, b, to) > 0;
  };
  const std::uint32_t start = at_.at(a);
  for (const bool onward : {true, false}) {  // around a one way, at the rim the other way, too
    std::uint32_t t = start;
    do {
      const Triangle& triangle = triangles_[t];
      const auto k = std::size_t(std::ranges::find(triangle, a) - triangle.begin());
      const std::uint32_t from = triangle[(k + 1) % 3], to = triangle[(k + 2) % 3];
      if (passes(from, to)) return {from, to};
      t = onward ? beside(a, to) : beside(from, a);
    } while (t != none && t != start);
  }
  return {none, none};
}

void Triangulation::connect(std::uint32_t a, std::uint32_t b) {
  stop_here();
  if (beside(a, b) == none && beside(b, a) == none) {
    // Every edge between the two is turned until none passes there any more [Sloan 1993].
    std::deque<Edge> between;
    for (auto [from, to] = first_between(a, b); from != none;) {
      between.push_back({from, to});
      const std::uint32_t next = apex(to, from);
      if (next == b || next == none) break;
      (plane_.orient(a, b, next) < 0 ? from : to) = next;
    }
    while (!between.empty()) {
      const auto [from, to] = between.front();
      between.pop_front();
      if (!can_turn(from, to)) {
        between.push_back({from, to});
        continue;
      }
      const auto [c, d] = turn(from, to);
      const int at_c = plane_.orient(a, b, c), at_d = plane_.orient(a, b, d);
      if (at_c * at_d < 0) between.push_back(at_c < 0 ? Edge{c, d} : Edge{d, c});
    }
  }
  fixed_.insert(key(std::min(a, b), std::max(a, b)));
}

void Triangulation::improve() {
  std::vector<Edge> edges;
  for (const auto& [edge, _] : left_of_) {
    const Edge ends{std::uint32_t(edge >> 32), std::uint32_t(edge)};
    if (ends[0] < ends[1]) edges.push_back(ends);
  }
  std::ranges::sort(edges);  // the same pieces on every machine
  settle(std::move(edges));
}

}  // namespace kreisel::core
