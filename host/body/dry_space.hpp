// dry_space.hpp - where water does not come: below its level, but within a hull.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// What of a mesh water leaves dry, at any level: the part of the surface at or below the plane z = level
/// that no water touches. That is the surface of hollows whose rim is above the plane all around and that
/// have no way out below it, and of cavities. Decided on the triangles: a wall keeps water out however thin
/// it is.
///
/// The section's loops and the pieces of surface below the plane tell it: two regions of the plane without
/// material are one water where a piece of surface ends in both. Most levels need the loops alone: where none
/// of them is around a hollow, only a cavity is dry.
class DrySpace {
 public:
  /// @param mesh  closed, outward; outlives it
  explicit DrySpace(const TriangleMesh& mesh);

  /// For each vertex whether it is of that part; empty where there is none.
  [[nodiscard]] std::vector<char> vertices(double level) const;

 private:
  const TriangleMesh& mesh_;
  bool cavities_;  ///< has the mesh any
};

}  // namespace kreisel::core
