// close_holes.hpp - patches where a surface is open.
#pragma once

#include <cstddef>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// What was closed; lengths in units of the mesh.
struct ClosedHoles {
  std::size_t count = 0;
  double widest = 0;   ///< across, of those that were closed
  double area = 0;     ///< of all patches
  double between = 0;  ///< volume between each patch and a fan about the middle of its rim: how far another
                       ///< patch might have changed the solid
};

/// Closes each hole by a patch without new points: triangles of least area [Barequet & Sharir 1995] over a
/// short rim, over a long one those of its outline on the plane that fits it best; where that crosses itself,
/// a fan about a new point in the middle. A rim that comes to a point twice is two holes. Where patches run
/// through the rest is the question of unite.hpp.
/// @param largest  a hole stays whose bounding box has a longer diagonal, units of the mesh
ClosedHoles close_holes(TriangleMesh& mesh, double largest);

}  // namespace kreisel::core
