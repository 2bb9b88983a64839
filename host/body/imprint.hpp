// imprint.hpp - the outline of an upright prism drawn on a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/polygon.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A mesh whose triangles end where they meet the sides of an upright prism.
struct Imprint {
  TriangleMesh mesh;
  std::vector<std::uint32_t> inside;  ///< triangles within the prism, by their numbers
  /// The shortest edge of a triangle that was cut: what a file that rounds must tell apart.
  double shortest = 0;
};

/// Cuts the triangles, one side of the prism after the other, each edge once for both that share it: a closed
/// mesh stays closed, and its surface where it is.
///
/// @param polygon  convex, counter-clockwise seen from above; no vertex of the mesh on a line of its sides
[[nodiscard]] Imprint imprint(const TriangleMesh& mesh, const Polygon& polygon);

}  // namespace kreisel::core
