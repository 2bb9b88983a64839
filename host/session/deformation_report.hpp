// deformation_report.hpp - what became of a body's shape.
#pragma once

#include <string>
#include <vector>

#include "deform/deformation.hpp"

namespace kreisel::core {

/// What became of a body's shape; model coordinates, mm.
struct DeformationReport {
  Reached reached = Reached::nothing;
  double largest_mm = 0;                       ///< displacement, up to a translation where nothing is kept
  double largest_percent = 0;                  ///< the same, of the longest side
  Vec3 where = Vec3::Zero();                   ///< of the vertex that moved most, before
  double volume_before = 0, volume_after = 0;  ///< mm^3
  double least_determinant = 1;
  double missed = 0;          ///< where nothing is reached: by how much at the least, body units
  bool too_far = false;       ///< the least that does needs more than is allowed
  std::size_t crossings = 0;  ///< pairs of triangles that would run through each other
  std::size_t split = 0;      ///< triangles that were added, for faces too large to bend
  std::vector<DeformStep> history;
  double energy = 0;                  ///< of the surface, as the published way weighs it: surface_energy()
  std::optional<JointOutcome> joint;  ///< of the published way: what it ended with
  double seconds = 0;
  /// With the triangles of the deformed mesh; where nothing is kept, moved to lie as near to it as may be.
  TriangleMesh before;
  std::vector<Vec3> displacement;  ///< of its vertices

  /// One sentence. @param problem  its verb: "spin"
  [[nodiscard]] std::string text() const;
};

}  // namespace kreisel::core
