// drawing.hpp - a solid drawn as a field, in units of its own, and the box in millimetres it is mapped to.
#pragma once

#include "body/models/implicit_mesh.hpp"

namespace kreisel::core {

struct Drawing {
  ScalarField field;  ///< in units of the drawing
  Box drawn;          ///< bounding box of { field < 0 }, found on a fine mesh
  Vec3 box_mm;        ///< extent of the model; its lower corner is at the origin
  double longest;     ///< cells along the longest side for each unit of fineness, for 20 fineness^2 triangles
};

/// Fineness below this is meshed as this: a lattice coarser still would lose ears and handles.
inline constexpr int coarsest_drawing = 30;

/// The drawing's surface in millimetres.
/// @param fineness  1 to 300; about 20 fineness^2 triangles from coarsest_drawing on
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh mesh_of(const Drawing& drawing, int fineness);

}  // namespace kreisel::core
