#include "nest/plane/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "error.hpp"
#include "geometry/distance.hpp"

namespace kreisel::core::nest {
namespace {

/// Pixels with a margin of one all around.
class Bitmap {
 public:
  Bitmap(int width, int height)
      : width_(width),
        height_(height),
        at_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int& operator()(int x, int y) { return at_[index(x, y)]; }
  [[nodiscard]] int operator()(int x, int y) const { return at_[index(x, y)]; }

  /// Gives all pixels of value `from` that hang together with this one, edge to edge, the value `to`.
  /// @return  their number
  std::size_t flood(int x, int y, int from, int to) {
    std::vector<std::array<int, 2>> open{{x, y}};
    std::size_t count = 0;
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (i < 0 || j < 0 || i >= width_ || j >= height_ || (*this)(i, j) != from) continue;
      (*this)(i, j) = to;
      ++count;
      for (const auto& [di, dj] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        open.push_back({i + di, j + dj});
    }
    return count;
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<int> at_;
};

/// Marks the pixels whose centres the triangle holds; coordinates in pixels.
void cover(Bitmap& bitmap, Vec2 a, Vec2 b, Vec2 c) {
  if (cross(b - a, c - a) < 0) std::swap(b, c);
  const auto first = [](double least) { return std::max(0, static_cast<int>(std::ceil(least - 0.5))); };
  const auto last = [](double most, int size) {
    return std::min(size - 1, static_cast<int>(std::floor(most - 0.5)));
  };
  for (int y = first(std::min({a.y(), b.y(), c.y()}));
       y <= last(std::max({a.y(), b.y(), c.y()}), bitmap.height()); ++y)
    for (int x = first(std::min({a.x(), b.x(), c.x()}));
         x <= last(std::max({a.x(), b.x(), c.x()}), bitmap.width()); ++x) {
      const Vec2 p(x + 0.5, y + 0.5);
      if (cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0) bitmap(x, y) = 1;
    }
}

constexpr int shape = 1, background = 2, largest = 3;

/// Where two of the piece's pixels touch at a corner alone, a third joins them: its border then meets no
/// corner twice.
void fill_pinches(Bitmap& bitmap) {
  for (bool again = true; again;) {
    again = false;
    for (int y = 0; y + 1 < bitmap.height(); ++y)
      for (int x = 0; x + 1 < bitmap.width(); ++x) {
        const auto in = [&](int i, int j) { return bitmap(x + i, y + j) == largest; };
        if (in(0, 0) != in(1, 1) || in(1, 0) != in(0, 1) || in(0, 0) == in(1, 0)) continue;
        bitmap(in(0, 0) ? x + 1 : x, y) = largest;
        again = true;
      }
  }
}

/// Fills holes and marks the piece with the most pixels. @return  whether there is one
bool mark_largest(Bitmap& bitmap) {
  bitmap.flood(0, 0, 0, background);
  for (int y = 0; y < bitmap.height(); ++y)
    for (int x = 0; x < bitmap.width(); ++x)
      if (bitmap(x, y) == 0) bitmap(x, y) = shape;
  std::size_t most = 0;
  std::array<int, 2> seed{};
  int mark = largest + 1;
  for (int y = 0; y < bitmap.height(); ++y)
    for (int x = 0; x < bitmap.width(); ++x)
      if (bitmap(x, y) == shape) {
        const std::size_t count = bitmap.flood(x, y, shape, mark++);
        if (count > most) {
          most = count;
          seed = {x, y};
        }
      }
  if (most) bitmap.flood(seed[0], seed[1], bitmap(seed[0], seed[1]), largest);
  fill_pinches(bitmap);
  return most > 0;
}

/// The marked piece's border, counter-clockwise (y up), by the middles of its pixels' edges: of a staircase
/// they lie on a line.
Polygon border(const Bitmap& bitmap) {
  const auto in = [&](int x, int y) { return bitmap(x, y) == largest; };
  int x = 0, y = 0;
  while (!in(x, y))
    if (++x == bitmap.width()) {
      x = 0;
      ++y;
    }
  // From the lower left corner of the lowest pixel eastwards, the piece on the left.
  const int start_x = x, start_y = y;
  int dx = 1, dy = 0;
  Polygon loop;
  do {
    loop.emplace_back(x + 0.5 * dx, y + 0.5 * dy);
    x += dx;
    y += dy;
    // Of the four pixels about the corner, those ahead to the left and to the right.
    const int lx = x + (dx - dy - 1) / 2, ly = y + (dx + dy - 1) / 2;
    const int rx = x + (dx + dy - 1) / 2, ry = y + (dy - dx - 1) / 2;
    if (!in(lx, ly)) {
      std::tie(dx, dy) = std::pair(-dy, dx);  // left
    } else if (in(rx, ry)) {
      std::tie(dx, dy) = std::pair(dy, -dx);  // right
    }
  } while (x != start_x || y != start_y || !(dx == 1 && dy == 0));
  return loop;
}

/// Keeps the vertices that a polyline from `first` to `last` needs to stay within `tolerance` [Douglas,
/// Peucker 1973].
void keep_needed(std::span<const Vec2> loop, std::size_t first, std::size_t last, double tolerance,
                 std::vector<char>& kept) {
  double most = tolerance;
  std::size_t far = 0;
  const Vec2 &a = loop[first], &b = loop[last % loop.size()];
  for (std::size_t i = first + 1; i < last; ++i)
    if (const double d = (loop[i] - nearest_on_segment(loop[i], a, b)).norm(); d > most) {
      most = d;
      far = i;
    }
  if (!far) return;
  kept[far] = 1;
  keep_needed(loop, first, far, tolerance, kept);
  keep_needed(loop, far, last, tolerance, kept);
}

Polygon straightened(const Polygon& loop, double tolerance) {
  std::size_t far = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    if ((loop[i] - loop[0]).squaredNorm() > (loop[far] - loop[0]).squaredNorm()) far = i;
  std::vector<char> kept(loop.size(), 0);
  kept[0] = kept[far] = 1;
  keep_needed(loop, 0, far, tolerance, kept);
  keep_needed(loop, far, loop.size(), tolerance, kept);
  Polygon result;
  for (std::size_t i = 0; i < loop.size(); ++i)
    if (kept[i]) result.push_back(loop[i]);
  return result;
}

/// Do two segments have a point in common? Those on one line are judged by their boxes.
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& from, const Vec2& to, const Vec2& p) {
    return cross(to - from, p - from);
  };
  if (side(a, b, c) * side(a, b, d) > 0 || side(c, d, a) * side(c, d, b) > 0) return false;
  return (a.cwiseMin(b).array() <= c.cwiseMax(d).array()).all() &&
         (c.cwiseMin(d).array() <= a.cwiseMax(b).array()).all();
}

bool crosses_itself(const Polygon& loop) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      const bool neighbours = i == 0 && j == n - 1;
      if (!neighbours && meet(loop[i], loop[i + 1], loop[j], loop[(j + 1) % n])) return true;
    }
  return false;
}

double height_at(const Vec2& a, const Vec2& b, double x) {
  return a.y() + (b.y() - a.y()) * ((x - a.x()) / (b.x() - a.x()));
}

}  // namespace

Polygon silhouette(const TriangleMesh& mesh, const Vec3& towards, const Vec3& up, int pixels) {
  if (pixels < 8 || pixels > 8192)
    throw InputError(fmt::format("silhouette of {} pixels; expected 8 to 8192", pixels));
  const Vec3 right = up.cross(towards);
  if (!(right.norm() > 1e-9 * up.norm() * towards.norm()))
    throw InputError("silhouette seen along its up direction; expected two directions that span a plane");
  const Vec3 x_axis = right.normalized(), y_axis = towards.cross(right).normalized();
  std::vector<Vec2> seen;
  for (const Vec3& v : mesh.vertices) seen.emplace_back(x_axis.dot(v), y_axis.dot(v));
  const auto box = bounding_box(seen);
  const double pixel = box.extent().maxCoeff() / pixels;
  if (!(pixel > 0) || !std::isfinite(pixel))
    throw InputError("silhouette of a mesh without extent; expected one");
  for (Vec2& p : seen) p = (p - box.lo) / pixel + Vec2::Ones();
  const auto cells = [&](int axis) { return static_cast<int>(std::ceil(box.extent()[axis] / pixel)) + 2; };
  Bitmap bitmap(cells(0), cells(1));
  for (const Triangle& t : mesh.triangles) cover(bitmap, seen[t[0]], seen[t[1]], seen[t[2]]);
  if (!mark_largest(bitmap))
    throw InputError(fmt::format("silhouette covers none of {} pixels; expected a solid", pixels));
  const Polygon loop = border(bitmap);
  Polygon result;
  double tolerance = 0.75;
  do {
    result = straightened(loop, tolerance);
    tolerance /= 2;
  } while (crosses_itself(result) && tolerance > 0.01);
  for (Vec2& p : result) p = box.lo + pixel * (p - Vec2::Ones());
  return result;
}

std::vector<OpenPart> open_to(std::span<const Vec2> polygon, double height) {
  const std::size_t n = polygon.size();
  std::vector<double> crossings;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % n];
    if ((a.y() <= height) == (b.y() <= height)) continue;
    crossings.push_back(a.x() + (b.x() - a.x()) * ((height - a.y()) / (b.y() - a.y())));
  }
  std::ranges::sort(crossings);
  std::vector<OpenPart> parts;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    OpenPart part{crossings[k], crossings[k + 1], {}};
    if (!(part.x0 < part.x1)) continue;
    std::vector<double> stops{part.x0, part.x1};
    for (const Vec2& p : polygon)
      if (part.x0 < p.x() && p.x() < part.x1) stops.push_back(p.x());
    std::ranges::sort(stops);
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    Polygon above;
    for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
      const double left = stops[s], right = stops[s + 1], middle = (left + right) / 2;
      // No edge ends or crosses another within, so what is nearest in the middle is nearest throughout.
      double ceiling = std::numeric_limits<double>::infinity(), floor = -ceiling;
      std::size_t over = n, under = n;
      for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % n];
        if ((a.x() < middle) == (b.x() < middle)) continue;
        const double y = height_at(a, b, middle);
        if (y > height && y < ceiling) {
          ceiling = y;
          over = i;
        } else if (y <= height && y > floor) {
          floor = y;
          under = i;
        }
      }
      if (over == n || under == n) continue;  // a sliver that round-off made
      for (const double x : {left, right}) {
        part.outline.emplace_back(x,
                                  std::min(height, height_at(polygon[under], polygon[(under + 1) % n], x)));
        above.emplace_back(x, std::max(height, height_at(polygon[over], polygon[(over + 1) % n], x)));
      }
    }
    part.outline.insert(part.outline.end(), above.rbegin(), above.rend());
    if (part.outline.size() >= 4) parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace kreisel::core::nest
