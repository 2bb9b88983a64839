#include "body/models/drawing.hpp"

#include <algorithm>

#include "body/models/shapes.hpp"

namespace kreisel::core {

TriangleMesh mesh_of(const Drawing& drawing, int fineness) {
  constexpr int finest = 300;  // 3 million triangles; the lattice takes close to a gigabyte
  require_fineness(fineness, finest);
  const Vec3 extent = drawing.drawn.extent();
  const double cells = drawing.longest * std::max(fineness, coarsest_drawing);
  TriangleMesh mesh = mesh_of(drawing.field, drawing.drawn, extent.maxCoeff() / cells);
  for (Vec3& v : mesh.vertices) v = (v - drawing.drawn.lo).cwiseQuotient(extent).cwiseProduct(drawing.box_mm);
  return mesh;
}

}  // namespace kreisel::core
