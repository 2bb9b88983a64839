#include "fabricate/swept_void.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/polygon.hpp"
#include "geometry/triangle.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

constexpr double none = -std::numeric_limits<double>::infinity();

/// Height of the cut.
double cut_at(const HalfView& view, double u, double v) {
  const auto& [normal, offset] = view.cut;
  return (offset - normal[0] * u - normal[1] * v) / normal[2];
}

/// What is known at a corner of the pixels.
struct Node {
  double surface = none;  ///< the shape's highest point there
  double top = none;      ///< of the void
  double inside = none;   ///< how far inside the void's outline; of nearby corners outside less than 0
  double rim = none;      ///< height of the outline next to it
};

class HeightField {
 public:
  HeightField(const TriangleMesh& shape, const HalfView& view, double radius, double pixel)
      : view_(view), radius_(radius), pixel_(pixel) {
    points_.reserve(shape.vertices.size());
    for (const Vec3& v : shape.vertices) points_.push_back(view.into(v));
    Box box;
    for (const Vec3& p : points_)
      if (within_reach(p)) box.add(p);
    // Triangles that reach across: their corners beyond the cut are there, the others bound them.
    for (const Triangle& t : shape.triangles) {
      if (std::ranges::none_of(t, [&](std::uint32_t v) { return within_reach(points_[v]); })) continue;
      triangles_.push_back(t);
      for (const std::uint32_t v : t) box.add(points_[v]);
    }
    if (triangles_.empty()) return;
    const double rim = radius + 3 * pixel;
    origin_ = {box.lo[0] - rim, box.lo[1] - rim};
    columns_ = static_cast<std::size_t>((box.extent()[0] + 2 * rim) / pixel) + 2;
    rows_ = static_cast<std::size_t>((box.extent()[1] + 2 * rim) / pixel) + 2;
    nodes_.resize(columns_ * rows_);
    for (const Triangle& t : triangles_) look_down_on(t);
    raise();
  }

  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] const Node& at(std::size_t i, std::size_t j) const { return nodes_[j * columns_ + i]; }
  [[nodiscard]] double u(std::size_t i) const { return origin_[0] + pixel_ * static_cast<double>(i); }
  [[nodiscard]] double v(std::size_t j) const { return origin_[1] + pixel_ * static_cast<double>(j); }

 private:
  /// Balls about what lies farther beneath the cut stay beneath it.
  [[nodiscard]] bool within_reach(const Vec3& p) const { return view_.cut.above(p) > -radius_; }

  /// The corners of pixels that a triangle covers.
  void look_down_on(const Triangle& t) {
    const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    const Vec3 normal = normal_of(a, b, c);
    if (normal[2] == 0) return;
    const double sign = normal[2] > 0 ? 1 : -1;
    const auto first = [&](double x, int axis) {
      return static_cast<std::size_t>(std::max(0.0, std::ceil((x - origin_[axis]) / pixel_)));
    };
    const auto last = [&](double x, int axis) {
      return static_cast<std::size_t>(std::floor((x - origin_[axis]) / pixel_));
    };
    const auto left_of = [&](const Vec3& p, const Vec3& q, double x, double y) {
      return sign * ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) >= 0;
    };
    for (std::size_t j = first(std::min({a[1], b[1], c[1]}), 1); j <= last(std::max({a[1], b[1], c[1]}), 1);
         ++j)
      for (std::size_t i = first(std::min({a[0], b[0], c[0]}), 0); i <= last(std::max({a[0], b[0], c[0]}), 0);
           ++i) {
        const double x = u(i), y = v(j);
        if (!left_of(a, b, x, y) || !left_of(b, c, x, y) || !left_of(c, a, x, y)) continue;
        const double height = a[2] - (normal[0] * (x - a[0]) + normal[1] * (y - a[1])) / normal[2];
        double& highest = nodes_[j * columns_ + i].surface;
        highest = std::max(highest, height);
      }
  }

  /// Balls about the corners that the shape covers, its vertices, and points of its edges.
  void raise() {
    std::vector<Vec3> centres;
    for (std::size_t j = 0; j < rows_; ++j)
      for (std::size_t i = 0; i < columns_; ++i)
        if (at(i, j).surface > none) centres.emplace_back(u(i), v(j), at(i, j).surface);
    std::vector<std::uint8_t> taken(points_.size());
    for (const Triangle& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = t[k], to = t[(k + 1) % 3];
        if (!std::exchange(taken[from], std::uint8_t{1})) add(centres, points_[from]);
        if (from > to) continue;  // its neighbour's
        const Vec3 edge = points_[to] - points_[from];
        const int parts = static_cast<int>(std::ceil(edge.norm() / pixel_));
        for (int n = 1; n < parts; ++n) add(centres, points_[from] + edge * n / parts);
      }
    // In bands of rows, each by itself; by where in the list a ball is, so that threads make no difference.
    constexpr std::size_t band = 32;
    const double reach = radius_ + 2 * pixel_;
    std::vector<std::vector<std::uint32_t>> in_band((rows_ + band - 1) / band);
    for (std::size_t c = 0; c < centres.size(); ++c) {
      if (!within_reach(centres[c])) continue;
      const auto [low, high] = rows_near(centres[c][1], reach);
      for (std::size_t b = low / band; b <= high / band; ++b)
        in_band[b].push_back(static_cast<std::uint32_t>(c));
    }
    parallel_for(in_band.size(), [&](std::size_t b) {
      for (const std::uint32_t c : in_band[b]) {
        auto [low, high] = rows_near(centres[c][1], reach);
        low = std::max(low, b * band);
        high = std::min(high, (b + 1) * band - 1);
        for (std::size_t j = low; j <= high; ++j) raise_row(centres[c], j, reach);
      }
    });
  }

  /// But for points that all four corners around them lie above: balls about those reach as far.
  void add(std::vector<Vec3>& centres, const Vec3& p) const {
    const auto i = static_cast<std::size_t>((p[0] - origin_[0]) / pixel_),
               j = static_cast<std::size_t>((p[1] - origin_[1]) / pixel_);
    const double least =
        std::min({at(i, j).surface, at(i + 1, j).surface, at(i, j + 1).surface, at(i + 1, j + 1).surface});
    if (least < p[2]) centres.push_back(p);
  }

  [[nodiscard]] std::pair<std::size_t, std::size_t> rows_near(double y, double reach) const {
    return {static_cast<std::size_t>(std::ceil((y - reach - origin_[1]) / pixel_)),
            static_cast<std::size_t>(std::floor((y + reach - origin_[1]) / pixel_))};
  }

  void raise_row(const Vec3& centre, std::size_t j, double reach) {
    const double beneath =
        std::max(0.0, cut_at(view_, centre[0], centre[1]) - centre[2]) * view_.cut.normal[2];
    const double rim_radius = std::sqrt(radius_ * radius_ - beneath * beneath);
    const double dy = v(j) - centre[1], half = std::sqrt(std::max(0.0, reach * reach - dy * dy));
    const auto begin = static_cast<std::size_t>(std::ceil((centre[0] - half - origin_[0]) / pixel_)),
               end = static_cast<std::size_t>(std::floor((centre[0] + half - origin_[0]) / pixel_));
    for (std::size_t i = begin; i <= end; ++i) {
      const double dx = u(i) - centre[0], square = dx * dx + dy * dy;
      Node& node = nodes_[j * columns_ + i];
      if (square < radius_ * radius_)
        node.top = std::max(node.top, centre[2] + std::sqrt(radius_ * radius_ - square));
      // Of points above each other, as those of an upright wall, the highest.
      const double inside = rim_radius - std::sqrt(square), rim = centre[2] + beneath / view_.cut.normal[2];
      if (inside > node.inside - 0.25 * pixel_)
        node.rim = inside > node.inside + 0.25 * pixel_ ? rim : std::max(node.rim, rim);
      node.inside = std::max(node.inside, inside);
    }
  }

  const HalfView& view_;
  double radius_, pixel_;
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  Vec2 origin_ = Vec2::Zero();
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Node> nodes_;
};

/// The field's inside, cut out of triangles of half a pixel each, over the same at the bottom.
class Solid {
 public:
  Solid(const HeightField& field, const HalfView& view, double below)
      : field_(field),
        view_(view),
        below_(below),
        corner_(field.columns() * field.rows(), nowhere),
        crossing_(3 * corner_.size(), nowhere) {
    for (std::size_t j = 0; j + 1 < field.rows(); ++j)
      for (std::size_t i = 0; i + 1 < field.columns(); ++i) {
        add({Place{i, j}, {i + 1, j}, {i + 1, j + 1}});
        add({Place{i, j}, {i + 1, j + 1}, {i, j + 1}});
      }
  }

  /// Normals into it.
  [[nodiscard]] TriangleMesh mesh() const {
    TriangleMesh mesh;
    const auto count = static_cast<std::uint32_t>(top_.size());
    for (const Vec3& p : top_) mesh.vertices.push_back(view_.out_of(p));
    for (const Vec3& p : top_)
      mesh.vertices.push_back(view_.out_of({p[0], p[1], cut_at(view_, p[0], p[1]) - below_}));
    for (const auto& [a, b, c] : triangles_) {
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({a + count, b + count, c + count});
    }
    for (const auto& [from, to] : rim_) {
      mesh.triangles.push_back({from + count, to, to + count});
      mesh.triangles.push_back({from + count, from, to});
    }
    return mesh;
  }

 private:
  static constexpr std::uint32_t nowhere = ~0u;
  struct Place {
    std::size_t i, j;
  };

  [[nodiscard]] bool inside(const Place& p) const { return field_.at(p.i, p.j).inside > 0; }
  [[nodiscard]] std::size_t id(const Place& p) const { return p.j * field_.columns() + p.i; }

  /// @param t  counter-clockwise
  void add(std::array<Place, 3> t) {
    const int count = inside(t[0]) + inside(t[1]) + inside(t[2]);
    if (count == 0) return;
    if (count == 3) {
      triangles_.push_back({corner(t[0]), corner(t[1]), corner(t[2])});
      return;
    }
    // Turned so that the first is the one alone on its side.
    while (inside(t[0]) != (count == 1) || inside(t[1]) == (count == 1) || inside(t[2]) == (count == 1))
      std::rotate(t.begin(), t.begin() + 1, t.end());
    const std::uint32_t ab = crossing(t[0], t[1]), ac = crossing(t[0], t[2]);
    if (count == 1) {
      triangles_.push_back({corner(t[0]), ab, ac});
      rim_.push_back({ab, ac});
    } else {
      const std::uint32_t b = corner(t[1]), c = corner(t[2]);
      triangles_.push_back({ab, b, c});
      triangles_.push_back({ab, c, ac});
      rim_.push_back({ac, ab});
    }
  }

  std::uint32_t vertex(double u, double v, double height) {
    // Beneath the cut it no longer matters how far, but it stays above the bottom.
    top_.emplace_back(u, v, std::max(height, cut_at(view_, u, v) - below_ / 2));
    return static_cast<std::uint32_t>(top_.size() - 1);
  }
  std::uint32_t corner(const Place& p) {
    std::uint32_t& known = corner_[id(p)];
    if (known == nowhere) known = vertex(field_.u(p.i), field_.v(p.j), field_.at(p.i, p.j).top);
    return known;
  }
  /// Where the outline runs between two corners, one of them inside.
  std::uint32_t crossing(Place in, Place out) {
    const Place &lower = id(in) < id(out) ? in : out, &upper = id(in) < id(out) ? out : in;
    const std::size_t kind = lower.j == upper.j ? 0 : lower.i == upper.i ? 1 : 2;
    std::uint32_t& known = crossing_[3 * id(lower) + kind];
    if (known != nowhere) return known;
    if (!inside(in)) std::swap(in, out);
    const Node &from = field_.at(in.i, in.j), &to = field_.at(out.i, out.j);
    // Clear of both, so that no file's precision makes one point of two.
    const double share = std::clamp(from.inside / (from.inside - to.inside), 0.1, 0.9);
    const auto between = [&](double a, double b) { return a + share * (b - a); };
    return known = vertex(between(field_.u(in.i), field_.u(out.i)), between(field_.v(in.j), field_.v(out.j)),
                          from.rim);
  }

  const HeightField& field_;
  const HalfView& view_;
  double below_;
  std::vector<std::uint32_t> corner_, crossing_;  ///< vertices
  std::vector<Vec3> top_;
  std::vector<Triangle> triangles_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rim_;  ///< the inside to the left
};

}  // namespace

TriangleMesh swept_void(const TriangleMesh& shape, const WayOff& way, double clearance, double pixel,
                        double below) {
  const HalfView view(way, way.direction);
  const HeightField field(shape, view, clearance + 1.5 * pixel, pixel);
  if (field.empty()) return {};
  return Solid(field, view, below).mesh();
}

}  // namespace kreisel::core
