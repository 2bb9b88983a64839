// deform.hpp - where no interior will do, the least change of shape with which one does.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "control.hpp"
#include "deform/held.hpp"
#include "deform/least_move.hpp"
#include "deform/shape.hpp"

namespace kreisel::core {

/// How far a body may be deformed, and how. Body units.
struct DeformOptions {
  /// The largest displacement allowed: the best objective within it. Nothing: as little as does.
  std::optional<double> within;
  int spans = 4;          ///< of the lattice, along the longest side
  double margin = 5e-3;   ///< by which constraints must be met to meet on another grid, and as meshes
  MoveOptions move = {};  ///< `held` follows from the next
  std::shared_ptr<const Held> held = {};  ///< what stays as it is; nothing: nothing does
};

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
  double seconds = 0;
};

/// Moves the handles of a lattice until an interior does what the problem asks: every quadric that separates
/// what is asked from all interiors gives a row that the motion must meet, by its derivative; of all motions
/// that meet them the nearest is taken, in steps. [docs/deformation.md]
///
/// @param body     undeformed; its mesh should have no faces longer than a twentieth of it (split_for_motion)
/// @param problem  of the undeformed body, and of every deformed one: what it asks depends on the moments
/// @throws Interrupted
[[nodiscard]] Deformation deform(const Body& body, const Problem& problem, const ShapeRays& rays,
                                 const DeformOptions& options, device::Device& device,
                                 const Control& control = {});

}  // namespace kreisel::core
