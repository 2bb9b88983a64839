// simplify.hpp - fewer triangles for the same surface.
#pragma once

#include <functional>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// How far a surface may move, the mesh's unit.
struct SurfaceTolerance {
  double along = 0;    ///< to the side that normals point to
  double against = 0;  ///< to the other
};

/// A mesh of fewer triangles. Its vertices are some of the given ones, where they are; each that is left out
/// lies within the tolerance of a triangle that is there in its place, on the side that is allowed. So the
/// Hausdorff distance of the vertices is bounded, and sharp edges stay within it.
///
/// Edges are collapsed to one of their ends [Hoppe 1996], the cheapest first by the sum of squared distances
/// from the planes that a vertex stands for [Garland, Heckbert 1997]; not where the mesh would lose its
/// topology, a triangle turn over, or become a sliver. Sheets nearer to each other than the tolerance might
/// come to run through each other: around such places all vertices stay. So the result runs through itself
/// nowhere, and lies where it may.
///
/// Same input, same mesh. Stops when asked to (stop_here()).
/// @param mesh  closed, each edge of two triangles, outward or inward throughout, not through itself
/// @param keeps  whether the surface may pass a point, as it does at all points of the mesh; asked in the
///               middle of triangles and of their sides, by several threads
[[nodiscard]] TriangleMesh simplified(const TriangleMesh& mesh, const SurfaceTolerance& tolerance,
                                      const std::function<bool(const Vec3&)>& keeps = {});

}  // namespace kreisel::core
