#include "geometry/cut_triangle.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/triangulation.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

Segment sorted(std::uint32_t a, std::uint32_t b) { return a < b ? Segment{a, b} : Segment{b, a}; }

/// A span of the x-axis that holds a segment, in double precision.
struct Span {
  double low, high;
  std::size_t segment;
};

/// All that lie side by side: calls visit(i, j) for the segments whose spans overlap.
template <class Visit>
void for_each_overlap(std::vector<Span> spans, Visit&& visit) {
  std::ranges::sort(spans, {}, &Span::low);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    stop_here();
    for (std::size_t j = i + 1; j < spans.size() && spans[j].low <= spans[i].high; ++j)
      visit(spans[i].segment, spans[j].segment);
  }
}

/// Wider than what a coordinate's nearest double may be off.
double widened(double x, double towards) { return x + towards * 4e-16 * std::abs(x); }

Span span_of(const ExactPlane& plane, const Segment& s, std::size_t number) {
  const double a = plane.near(s[0])[0], b = plane.near(s[1])[0];
  return {widened(std::min(a, b), -1), widened(std::max(a, b), 1), number};
}

bool apart_in_y(const ExactPlane& plane, const Segment& s, const Segment& t) {
  const double a = plane.near(s[0])[1], b = plane.near(s[1])[1], c = plane.near(t[0])[1],
               d = plane.near(t[1])[1];
  return widened(std::max(a, b), 1) < widened(std::min(c, d), -1) ||
         widened(std::max(c, d), 1) < widened(std::min(a, b), -1);
}

/// Cuts segments where they cross each other and where points lie on them.
std::set<Segment> split_segments(const ExactPlane& plane, const std::vector<Segment>& segments,
                                 const std::function<std::uint32_t(ExactPoint)>& number) {
  std::vector<Span> spans;
  std::vector<std::vector<std::uint32_t>> on(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    spans.push_back(span_of(plane, segments[i], i));
    on[i] = {segments[i][0], segments[i][1]};
  }
  for_each_overlap(spans, [&](std::size_t i, std::size_t j) {
    const auto [a, b] = segments[i];
    const auto [c, d] = segments[j];
    if (apart_in_y(plane, segments[i], segments[j])) return;
    const auto touch = [&](int side, std::uint32_t p, std::size_t of) {
      const auto& [from, to] = segments[of];
      if (side == 0 && between(plane.exact(from), plane.exact(p), plane.exact(to))) on[of].push_back(p);
    };
    if (a == c || a == d || b == c || b == d) {  // then only one that lies along the other touches it
      const std::uint32_t p = a == c || a == d ? b : a, q = c == a || c == b ? d : c;
      const int side = plane.orient(c, d, p);
      touch(side, p, j);
      touch(side, q, i);
      return;
    }
    const int ca = plane.orient(c, d, a), cb = plane.orient(c, d, b);
    if (ca * cb > 0) return;
    const int ac = plane.orient(a, b, c), ad = plane.orient(a, b, d);
    if (ac * ad > 0) return;
    if (ca * cb < 0 && ac * ad < 0) {
      const std::uint32_t at =
          number(lines_meet(plane.exact(a), plane.exact(b), plane.exact(c), plane.exact(d), plane.axis()));
      on[i].push_back(at);
      on[j].push_back(at);
      return;
    }
    touch(ca, a, j);
    touch(cb, b, j);
    touch(ac, c, i);
    touch(ad, d, i);
  });
  std::set<Segment> pieces;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto& first = plane.exact(segments[i][0]);
    const auto before = [&](std::uint32_t p, std::uint32_t q) {
      return p != q && between(first, plane.exact(p), plane.exact(q));
    };
    if (on[i].size() > 2) std::ranges::sort(on[i], before);
    for (std::size_t k = 1; k < on[i].size(); ++k)
      if (on[i][k - 1] != on[i][k]) pieces.insert(sorted(on[i][k - 1], on[i][k]));
  }
  return pieces;
}

}  // namespace

TrianglePieces cut_triangle(const Triangle& corners, const std::vector<Segment>& segments,
                            const PointOf& point, const std::function<std::uint32_t(ExactPoint)>& number) {
  const ExactPlane plane(corners, point);
  std::set<Segment> different;  // neighbours that meet the triangle have their edges in common
  for (const auto& [a, b] : segments) different.insert(sorted(a, b));
  for (std::size_t k = 0; k < 3; ++k) different.insert(sorted(corners[k], corners[(k + 1) % 3]));
  const std::vector<Segment> all(different.begin(), different.end());
  std::set<Segment> lines = split_segments(plane, all, number);
  std::set<std::uint32_t> points;
  for (const auto& [a, b] : lines) points.insert({a, b});
  for (const auto& [a, b] : segments) points.insert({a, b});
  Triangulation pieces(plane, corners);
  for (const std::uint32_t p : points)
    if (std::ranges::find(corners, p) == corners.end()) pieces.insert(p);
  for (const auto& [a, b] : lines) pieces.connect(a, b);
  pieces.improve();
  return {pieces.triangles(), std::move(lines)};
}

}  // namespace kreisel::core
