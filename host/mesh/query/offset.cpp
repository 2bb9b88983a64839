#include "mesh/query/offset.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/query/reach.hpp"
#include "mesh/query/sides.hpp"
#include "parallel.hpp"

namespace kreisel::core {
namespace {

constexpr int band_rows = 16;

/// The lines of a few neighbouring rows while pieces of the shell are taken out of them.
class Band {
 public:
  Band(const LineRaster& raster, int first_row, std::vector<std::vector<Span>>& lines)
      : raster_(raster),
        first_(first_row),
        end_(std::min(first_row + band_rows, raster.ny)),
        lines_(lines),
        hull_(static_cast<std::size_t>(end_ - first_) * raster.nx) {
    for (std::size_t i = 0; i < hull_.size(); ++i) hull_[i] = hull_of(line(i));
  }

  [[nodiscard]] bool meets(double y0, double y1) const {
    return y1 >= raster_.y(first_) - slack() && y0 <= raster_.y(end_ - 1) + slack();
  }

  /// Takes out what `shape` says of every line that it may reach.
  template <class Shape>
  void remove(const Shape& shape) {
    const auto [y0, y1] = shape.rows();
    const int j0 = std::max(first_, at_least((y0 - raster_.y0) / raster_.h));
    const int j1 = std::min(end_ - 1, at_most((y1 - raster_.y0) / raster_.h));
    for (int j = j0; j <= j1; ++j) {
      const double y = raster_.y(j);
      const auto [x0, x1] = shape.columns(y);
      const int i0 = std::max(0, at_least((x0 - raster_.x0) / raster_.h));
      const int i1 = std::min(raster_.nx - 1, at_most((x1 - raster_.x0) / raster_.h));
      const std::size_t row = static_cast<std::size_t>(j - first_) * raster_.nx;
      for (int i = i0; i <= i1; ++i) {
        const Span& hull = hull_[row + i];
        if (!(hull.z0 < hull.z1)) continue;
        const Span span = shape.span(raster_.x(i), y);
        if (span.z0 < span.z1 && span.z0 < hull.z1 && span.z1 > hull.z0) subtract(row + i, span);
      }
    }
  }

  void drop_short_ones() {
    for (std::size_t i = 0; i < hull_.size(); ++i)
      std::erase_if(line(i), [&](const Span& s) { return s.z1 - s.z0 < 1e-7 * raster_.h; });
  }

 private:
  /// A line on the rim of a shape must not be missed for the rounding of its place in the raster.
  [[nodiscard]] double slack() const { return 1e-6 * raster_.h; }
  static int at_least(double i) { return static_cast<int>(std::ceil(std::clamp(i, -1e9, 1e9) - 1e-6)); }
  static int at_most(double i) { return static_cast<int>(std::floor(std::clamp(i, -1e9, 1e9) + 1e-6)); }

  [[nodiscard]] std::vector<Span>& line(std::size_t i) const {
    return lines_[static_cast<std::size_t>(first_) * raster_.nx + i];
  }

  static Span hull_of(const std::vector<Span>& line) {
    return line.empty() ? Span{0, 0} : Span{line.front().z0, line.back().z1};
  }

  void subtract(std::size_t i, const Span& out) {
    auto& spans = line(i);
    for (std::size_t k = 0; k < spans.size(); ++k) {
      Span& s = spans[k];
      if (s.z1 <= out.z0) continue;
      if (s.z0 >= out.z1) break;
      const Span above{out.z1, s.z1};
      const bool left_below = s.z0 < out.z0, left_above = above.z0 < above.z1;
      if (left_below) s.z1 = out.z0;
      if (left_below && left_above) {
        spans.insert(spans.begin() + static_cast<std::ptrdiff_t>(k) + 1, above);
        break;
      }
      if (left_below) continue;
      if (left_above) {
        s = above;
        break;
      }
      spans.erase(spans.begin() + static_cast<std::ptrdiff_t>(k));
      --k;
    }
    hull_[i] = hull_of(spans);
  }

  const LineRaster& raster_;
  int first_, end_;
  std::vector<std::vector<Span>>& lines_;
  std::vector<Span> hull_;  ///< of what is left of each line; empty: nothing
};

/// Edges as pairs of vertices, each once.
std::vector<std::array<std::uint32_t, 2>> edges_of(const TriangleMesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for_each_edge(sorted_sides(mesh), [&](auto first, auto) { edges.push_back({first->low, first->high}); });
  return edges;
}

std::vector<std::uint32_t> used_vertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < used.size(); ++v)
    if (used[v]) vertices.push_back(v);
  return vertices;
}

}  // namespace

void remove_shell(const TriangleMesh& mesh, double wall, const LineRaster& raster,
                  std::vector<std::vector<Span>>& lines) {
  const auto corners = used_vertices(mesh);
  const auto edges = edges_of(mesh);
  const auto& v = mesh.vertices;
  const std::size_t bands = static_cast<std::size_t>((raster.ny + band_rows - 1) / band_rows);
  parallel_for(bands, [&](std::size_t b) {
    Band band(raster, static_cast<int>(b) * band_rows, lines);
    // Balls first: the cheapest, and on a fine mesh they leave little for the others.
    for (const std::uint32_t i : corners)
      if (band.meets(v[i][1] - wall, v[i][1] + wall)) band.remove(reach::Ball(v[i], wall));
    for (const Triangle& t : mesh.triangles) {
      const auto [y0, y1] = std::minmax({v[t[0]][1], v[t[1]][1], v[t[2]][1]});
      if (band.meets(y0 - wall, y1 + wall))
        if (const reach::Prism prism(v[t[0]], v[t[1]], v[t[2]], wall); !prism.flat()) band.remove(prism);
    }
    for (const auto& [i, j] : edges) {
      const auto [y0, y1] = std::minmax(v[i][1], v[j][1]);
      if (band.meets(y0 - wall, y1 + wall) && v[i] != v[j]) band.remove(reach::Cylinder(v[i], v[j], wall));
    }
    band.drop_short_ones();
  });
}

}  // namespace kreisel::core
