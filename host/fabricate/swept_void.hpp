// swept_void.hpp - the space that a shape needs to be taken out of a half.
#pragma once

#include "geometry/plane.hpp"

namespace kreisel::core {

/// How one half of a cut shape leaves another shape behind.
struct WayOff : Plane {  ///< the cut: a normal of unit length, into the half
  Vec3 direction;        ///< unit length, normal . direction > 0: where the half goes
};

/// The boundary of everything within `clearance` of the shape's part beyond the cut, and of that on its way
/// back along the direction to the cut: a height field over the cut, seen along the direction, with walls
/// along it, that goes on to `below` beneath the cut. [Nest, s. 3 and 8]
///
/// Heights are those of balls about points of the surface a pixel apart at the most, their radius larger by a
/// pixel and a half, which covers what lies between the points and between the pixels. So the surface is
/// nowhere nearer to the shape than the clearance, and, at a pixel's step, nowhere farther than two and a
/// half pixels more. Closed, a manifold, and free of self-intersections whatever the shape is.
///
/// @param pixel  > 0; lengths in the mesh's unit
/// @return       normals into the void (out of the material), as a cavity's; empty where nothing of the shape
///               is within reach of the half
[[nodiscard]] TriangleMesh swept_void(const TriangleMesh& shape, const WayOff& way, double clearance,
                                      double pixel, double below);

}  // namespace kreisel::core
