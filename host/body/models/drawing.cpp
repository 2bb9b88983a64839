#include "body/models/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "error.hpp"

namespace kreisel::core {

TriangleMesh mesh_of(const Drawing& drawing, int fineness) {
  constexpr int finest = 300;  // 3 million triangles; the lattice takes close to a gigabyte
  if (fineness < 1 || fineness > finest)
    throw InputError(fmt::format("fineness {}, expected 1 to {}", fineness, finest));
  const Vec3 extent = drawing.drawn.extent();
  const double cells = drawing.longest * std::max(fineness, coarsest_drawing);
  TriangleMesh mesh = mesh_of(drawing.field, drawing.drawn, extent.maxCoeff() / cells);
  for (Vec3& v : mesh.vertices) v = (v - drawing.drawn.lo).cwiseQuotient(extent).cwiseProduct(drawing.box_mm);
  return mesh;
}

}  // namespace kreisel::core
