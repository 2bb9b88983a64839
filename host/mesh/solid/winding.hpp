// winding.hpp - how often a surface winds around a place, exactly.
#pragma once

#include "mesh/solid/arrange.hpp"

namespace kreisel::core {

/// The winding numbers on both sides of a patch of an arrangement: how many times the surface encloses a
/// place, what runs inside out counted as less.
struct PatchSides {
  int front = 0;  ///< where its triangles run counter-clockwise
  int back = 0;
  bool repeated = false;  ///< another patch with a lower number lies on it, and runs the same way
};

/// For every face the sides of its patch. By a ray from the middle of a face of each patch, with exact signs.
/// @param mesh          that was arranged  @param arrangement  closed
/// @throws InputError   no ray does that passes no edge: not so with any triangles but few
[[nodiscard]] std::vector<PatchSides> winding(const TriangleMesh& mesh, const Arrangement& arrangement);

}  // namespace kreisel::core
