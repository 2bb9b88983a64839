// offset.hpp - the exact inner offset of a closed mesh along vertical lines.
#pragma once

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

/// Takes out of every line what is nearer to the surface than `wall`.
///
/// The points within `wall` of a triangle are the union of a prism (the triangle, swept along its normal both
/// ways), three cylinders about its edges and three balls about its corners. Each is convex, so a line meets
/// it in one span, and each span has a closed form: nothing is sampled. Edges and corners are taken once for
/// all triangles that share them; triangles without area are their edges.
///
/// Everything is computed in double: an end of a span is as deep as the wall up to round-off in the mesh's
/// coordinates, however flat the line meets the offset surface. Parts shorter than 1e-7 h, which the seams
/// between the pieces can leave, are taken out too.
///
/// @param mesh   any triangles; only their distance counts
/// @param wall   > 0, the mesh's unit
/// @param lines  nx * ny lists, indexed i + nx * j: disjoint spans in ascending order
///
/// O(lines + features times the lines each of them reaches), on all threads.
void remove_shell(const TriangleMesh& mesh, double wall, const LineRaster& raster,
                  std::vector<std::vector<Span>>& lines);

}  // namespace kreisel::core
