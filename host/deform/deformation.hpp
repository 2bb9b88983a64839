// deformation.hpp - what a deformation comes to.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// What a deformation reaches: nothing of what is asked; the constraints; or all that verify() asks.
enum class Reached { nothing, constraints, all };

/// "nothing", "constraints" or "all".
[[nodiscard]] std::string_view to_string(Reached reached);

/// One step of the search. Body units.
struct DeformStep {
  double missed = 0;     ///< the least by which any interior misses what is asked
  double largest = 0;    ///< displacement
  std::size_t cuts = 0;  ///< quadrics that separated a shape so far
};

/// Of cells and handles solved for together: where that ended.
struct JointOutcome {
  double objective = 0;  ///< without the regularisers
  double violation = 0;  ///< of the constraints, body units
  int iterations = 0;
  std::size_t variables = 0;
};

/// Body frame and units of the undeformed body.
struct Deformation {
  Reached reached = Reached::nothing;
  TriangleMesh local;          ///< the anchor stays where it is, or else what is held
  Vec3 anchor = Vec3::Zero();  ///< where the problem's anchor is now
  double largest = 0;          ///< displacement of a vertex, up to a translation where nothing is held
  Vec3 where = Vec3::Zero();   ///< of that vertex, undeformed
  double volume = 1;           ///< of the undeformed one
  double least_determinant = 1;
  double missed = 0;          ///< by the interior that misses least; 0 where something is reached
  bool too_far = false;       ///< it would do, but is farther than allowed
  std::size_t crossings = 0;  ///< pairs of triangles that run through each other; then nothing is reached
  std::vector<DeformStep> history;
  std::optional<JointOutcome> joint;  ///< of the published way
  double seconds = 0;
};

}  // namespace kreisel::core
