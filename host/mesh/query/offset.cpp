#include "mesh/query/offset.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/triangle.hpp"
#include "mesh/query/band.hpp"
#include "mesh/query/reach.hpp"
#include "mesh/query/sides.hpp"
#include "parallel.hpp"
#include "stop.hpp"

namespace kreisel::core {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// Below this height, in longest sides, a triangle's normal is not believed: round-off turns it by 1e-16 over
/// the height.
constexpr double thin = 1e-5;
/// By which boxes are widened, in walls: far above what `thin` leaves to a normal.
constexpr double margin = 1e-6;

/// Where each of things with keys below `most` goes when they are sorted by them.
std::vector<std::uint32_t> sorted_places(const std::vector<std::uint32_t>& keys, std::uint32_t most) {
  std::vector<std::uint32_t> next(most + 1, 0), place(keys.size());
  for (const std::uint32_t k : keys) ++next[k + 1];
  for (std::uint32_t k = 1; k <= most; ++k) next[k] += next[k - 1];
  for (std::size_t i = 0; i < keys.size(); ++i) place[i] = next[keys[i]]++;
  return place;
}

/// The same triangles without vertices of none, in rows of small squares seen from above: what a band of
/// lines reads lies close together.
TriangleMesh in_rows(const TriangleMesh& mesh) {
  constexpr std::uint32_t squares = 128, unused = squares * squares;
  const Box box = bounding_box(mesh);
  const double per_square = squares / std::max({box.extent()[0], box.extent()[1], 1e-300});
  std::vector<std::uint32_t> square(mesh.vertices.size(), unused);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) {
      const Vec3 at = (mesh.vertices[v] - box.lo) * per_square;
      const auto index = [](double x) { return std::min(static_cast<std::uint32_t>(x), squares - 1); };
      square[v] = index(at[0]) + squares * index(at[1]);
    }
  const std::vector<std::uint32_t> vertex = sorted_places(square, unused + 1);
  TriangleMesh sorted;
  sorted.vertices.resize(mesh.vertices.size() - static_cast<std::size_t>(std::ranges::count(square, unused)));
  for (std::size_t v = 0; v < vertex.size(); ++v)
    if (square[v] != unused) sorted.vertices[vertex[v]] = mesh.vertices[v];

  std::vector<std::uint32_t> first(mesh.triangles.size());
  for (std::size_t t = 0; t < first.size(); ++t) first[t] = square[mesh.triangles[t][0]];
  const std::vector<std::uint32_t> triangle = sorted_places(first, unused);
  sorted.triangles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const auto [i, j, k] = mesh.triangles[t];
    sorted.triangles[triangle[t]] = {vertex[i], vertex[j], vertex[k]};
  }
  return sorted;
}

double longest_side_squared(const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

/// Of unit length; zero where it is not to be believed.
Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = normal_of(a, b, c);
  const double area = n.norm();
  if (!(area > thin * longest_side_squared(a, b, c))) return Vec3::Zero();
  return n / area;
}

std::vector<std::array<std::uint32_t, 3>> neighbours_of(const TriangleMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> across(mesh.triangles.size(), {nobody, nobody, nobody});
  for_each_edge(sorted_sides(mesh), [&](auto first, auto last) {
    if (last - first != 2) return;
    across[first[0].triangle][first[0].corner] = first[1].triangle;
    across[first[1].triangle][first[1].corner] = first[0].triangle;
  });
  return across;
}

/// How far off a piece nothing is farther than the wall from its corners.
/// @param cover_squared  of the piece: every point of it is as near to a corner
double covered_height(double wall, double cover_squared) {
  return std::sqrt(std::max(0.0, wall * wall - 1.001 * cover_squared));
}

template <class... Points>
Box box_of(const Points&... points) {
  Box box;
  (box.add(points), ...);
  return box;
}

/// Everything that is a point of one and a point of the other, added.
Box sum(const Box& a, const Box& b) { return {a.lo + b.lo, a.hi + b.hi}; }

Box widened(const Box& box, double by) { return {box.lo - Vec3::Constant(by), box.hi + Vec3::Constant(by)}; }

}  // namespace

/// The pieces near one triangle, taken out of a band.
class ShellPieces::Cutter {
 public:
  Cutter(const ShellPieces& pieces, double wall, Band& band) : p_(pieces), wall_(wall), band_(band) {}

  void remove_prism(std::uint32_t t) {
    const auto [a, b, c] = corners(t);
    const double height = covered_height(wall_, longest_side_squared(a, b, c) / 3);
    const Box triangle = box_of(a, b, c);
    const Vec3& n = p_.normals_[t];
    if (n.isZero())
      prism(t, window(triangle, wall_), {});
    else
      prism(t, window(sum(triangle, box_of(height * n, wall_ * n))),
            window(sum(triangle, box_of(-height * n, -wall_ * n))));
  }

  /// Of the side from corner k to the next, once for both triangles beside it.
  void remove_cylinder(std::uint32_t t, std::size_t k) {
    const std::uint32_t other = p_.across_[t][k];
    if (other != nobody && other < t) return;
    const Triangle& own = p_.mesh_.triangles[t];
    const Vec3 &a = vertex(own[k]), &b = vertex(own[(k + 1) % 3]);
    if (a == b) return;
    const Box edge = box_of(a, b);
    if (other == nobody || p_.normals_[t].isZero() || p_.normals_[other].isZero())
      return cylinder(a, b, window(edge, wall_));
    const Triangle& theirs = p_.mesh_.triangles[other];
    std::size_t opposite = 0;
    while (theirs[opposite] == own[k] || theirs[opposite] == own[(k + 1) % 3]) ++opposite;
    wedge(a, b, edge, p_.normals_[t], vertex(own[(k + 2) % 3]) - a, p_.normals_[other],
          vertex(theirs[opposite]) - a);
  }

 private:
  [[nodiscard]] const Vec3& vertex(std::uint32_t i) const { return p_.mesh_.vertices[i]; }
  [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t t) const {
    return corners_of(p_.mesh_, p_.mesh_.triangles[t]);
  }
  [[nodiscard]] Window window(const Box& box, double by = 0) const {
    return band_.window(widened(box, by + margin * wall_));
  }

  void prism(std::uint32_t t, const Window& above, const Window& below) {
    if (!band_.reaches(above) && !band_.reaches(below)) return;
    const auto [a, b, c] = corners(t);
    const reach::Prism prism(a, b, c, wall_);
    if (prism.flat()) return;
    band_.remove(prism, above);
    band_.remove(prism, below);
  }

  void cylinder(const Vec3& a, const Vec3& b, const Window& w) {
    if (band_.reaches(w)) band_.remove(reach::Cylinder(a, b, wall_), w);
  }

  /// Only points from which both triangles fall away from the edge can be nearest to it. Seen along the edge
  /// they are a sector between two of the triangles' normals.
  void wedge(const Vec3& a, const Vec3& b, const Box& edge, const Vec3& n, const Vec3& to_own,
             const Vec3& other_n, const Vec3& to_other) {
    const double height = covered_height(wall_, (b - a).squaredNorm() / 4);
    // Where the triangles are nearly in a plane, round-off must not say on which side they fall away.
    constexpr double flat = 1e-3;
    if (const double turn = n.dot(other_n); std::abs(turn) > 1 - flat * flat / 2) {
      const Vec3 ahead = n.cross(b - a);
      if ((ahead.dot(to_own) > 0) == (ahead.dot(to_other) > 0)) return cylinder(a, b, window(edge, wall_));
      const Vec3 same = turn > 0 ? other_n : Vec3(-other_n);
      for (const double s : {1.0, -1.0})
        cylinder(
            a, b,
            window(sum(edge, box_of(s * height * n, s * height * same, s * wall_ * n, s * wall_ * same))));
      return;
    }
    const Vec3 m = n.dot(to_other) > 0 ? -n : n, other_m = other_n.dot(to_own) > 0 ? -other_n : other_n;
    const double cosine = m.dot(other_m);
    if (cosine < -0.5) return cylinder(a, b, window(edge, wall_));
    const Vec3 tip = (m + other_m) / (1 + cosine);  // where the tangents at the sector's ends meet
    cylinder(
        a, b,
        window(sum(edge, box_of(height * m, height * other_m, wall_ * m, wall_ * other_m, wall_ * tip))));
  }

  const ShellPieces& p_;
  double wall_;
  Band& band_;
};

ShellPieces::ShellPieces(const TriangleMesh& mesh)
    : mesh_(in_rows(mesh)), normals_(mesh_.triangles.size()), across_(neighbours_of(mesh_)) {
  for (std::size_t t = 0; t < normals_.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh_, mesh_.triangles[t]);
    normals_[t] = unit_normal(a, b, c);
  }
}

LineSpans ShellPieces::without_shell(double wall, const LineRaster& raster, const LineSpans& lines) const {
  const auto& v = mesh_.vertices;
  // As many rows as make the work even on a few threads, yet so many that few pieces reach into two bands.
  const int rows = std::max(8, (raster.ny + 15) / 16);
  const auto bands = static_cast<std::size_t>((raster.ny + rows - 1) / rows);
  std::vector<std::vector<std::uint32_t>> balls(bands), triangles(bands);
  const auto list = [&](std::vector<std::vector<std::uint32_t>>& of, std::uint32_t what, double y0,
                        double y1) {
    const double first = (y0 - (1 + margin) * wall - raster.y0) / raster.h - margin,
                 last = (y1 + (1 + margin) * wall - raster.y0) / raster.h + margin;
    if (last < 0 || first > raster.ny) return;
    const auto from = static_cast<std::size_t>(std::max(first, 0.0)) / static_cast<std::size_t>(rows),
               to =
                   static_cast<std::size_t>(std::min(last, raster.ny - 1.0)) / static_cast<std::size_t>(rows);
    for (std::size_t b = from; b <= to && b < bands; ++b) of[b].push_back(what);
  };
  for (std::uint32_t i = 0; i < v.size(); ++i) list(balls, i, v[i][1], v[i][1]);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Triangle& k = mesh_.triangles[t];
    const auto [y0, y1] = std::minmax({v[k[0]][1], v[k[1]][1], v[k[2]][1]});
    list(triangles, t, y0, y1);
  }

  std::vector<LineSpans> parts(bands);
  parallel_for(bands, [&](std::size_t b) {
    const int first = static_cast<int>(b) * rows;
    Band band(raster, first, std::min(first + rows, raster.ny), lines);
    // A few everywhere first: they leave little for the others.
    constexpr std::size_t stride = 16;
    for (std::size_t from = 0; from < stride; ++from)
      for (std::size_t i = from; i < balls[b].size(); i += stride) {
        stop_here();
        band.remove_ball(v[balls[b][i]], wall);
      }
    Cutter cutter(*this, wall, band);
    for (const std::uint32_t t : triangles[b]) {
      stop_here();
      cutter.remove_prism(t);
      for (std::size_t k = 0; k < 3; ++k) cutter.remove_cylinder(t, k);
    }
    parts[b] = band.left(1e-7 * raster.h);
  });
  LineSpans all;
  all.first.reserve(lines.first.size());
  for (const LineSpans& part : parts) {
    const auto before = static_cast<std::uint32_t>(all.spans.size());
    for (std::size_t k = 1; k < part.first.size(); ++k) all.first.push_back(before + part.first[k]);
    all.spans.insert(all.spans.end(), part.spans.begin(), part.spans.end());
  }
  return all;
}

}  // namespace kreisel::core
