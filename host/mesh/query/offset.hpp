// offset.hpp - the exact inner offset of a closed mesh along vertical lines.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A part of a vertical line; z0 < z1, the mesh's unit.
struct Span {
  double z0, z1;
};

/// Vertical lines at (x0 + h i, y0 + h j), i in [0, nx), j in [0, ny); h > 0, the mesh's unit.
struct LineRaster {
  double x0, y0, h;
  int nx, ny;

  [[nodiscard]] double x(int i) const { return x0 + h * i; }
  [[nodiscard]] double y(int j) const { return y0 + h * j; }
};

/// Spans of the lines of a raster, line i + nx * j after line i - 1 + nx * j.
struct LineSpans {
  std::vector<std::uint32_t> first = {0};  ///< of every line, and the end
  std::vector<Span> spans;                 ///< of a line: disjoint, in ascending order

  [[nodiscard]] std::size_t lines() const { return first.size() - 1; }
  [[nodiscard]] std::span<const Span> operator[](std::size_t line) const {
    return {spans.data() + first[line], spans.data() + first[line + 1]};
  }
  /// Says that all spans added since are those of the next line.
  void end_line() { first.push_back(static_cast<std::uint32_t>(spans.size())); }
};

/// What the points near a surface are near to: its corners, edges and triangles. Knows no wall, so it serves
/// all.
///
/// The points within a wall of a triangle are the union of a prism (the triangle, swept along its normal both
/// ways), three cylinders about its edges and three balls about its corners. Each is convex, so a line meets
/// it in one span, and each span has a closed form: nothing is sampled. Edges and corners are taken once for
/// all triangles that share them; triangles without area are their edges.
///
/// Balls come first. They leave of a small triangle's prism two slabs about as thick as the square of its
/// size over the wall, and of a cylinder what lies between the normals of the triangles beside it: another
/// point is nearer to one of those. Lines that miss the slab's or the wedge's box are not asked.
class ShellPieces {
 public:
  /// @param mesh  any triangles; only their distance counts
  explicit ShellPieces(const TriangleMesh& mesh);

  /// The lines without what is nearer to the surface than `wall`.
  ///
  /// Everything is computed in double: an end of a span is as deep as the wall up to round-off in the mesh's
  /// coordinates, however flat the line meets the offset surface. Parts shorter than 1e-7 h, which the seams
  /// between the pieces can leave, are left out too.
  ///
  /// @param wall  > 0, the mesh's unit
  ///
  /// O(lines + corners times the lines each of them reaches), on all threads.
  [[nodiscard]] LineSpans without_shell(double wall, const LineRaster& raster, const LineSpans& lines) const;

 private:
  class Cutter;

  TriangleMesh mesh_;          ///< neighbours beside each other; every vertex is of a triangle
  std::vector<Vec3> normals_;  ///< of unit length; zero where a triangle is too thin to say
  /// By triangle and side (from corner k to the next): the one triangle across it, or `nobody`.
  std::vector<std::array<std::uint32_t, 3>> across_;
};

}  // namespace kreisel::core
