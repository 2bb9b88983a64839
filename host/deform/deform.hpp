// deform.hpp - where no interior will do, the least change of shape with which one does.
#pragma once

#include <memory>
#include <optional>

#include "control.hpp"
#include "deform/deform_settings.hpp"
#include "deform/deformation.hpp"
#include "deform/held.hpp"
#include "deform/least_move.hpp"
#include "deform/shape.hpp"

namespace kreisel::core {

/// How far a body may be deformed, and how. Body units.
struct DeformOptions {
  /// The largest displacement allowed: the best objective within it. Nothing: as little as does.
  std::optional<double> within;
  DeformSettings settings = {};
  int spans = 4;          ///< of the lattice, along the longest side
  double margin = 5e-3;   ///< by which constraints must be met to meet on another grid, and as meshes
  MoveOptions move = {};  ///< `held` follows from the next
  std::shared_ptr<const Held> held = {};  ///< what stays as it is; nothing: nothing does
};

/// Moves handles until an interior does what the problem asks: every quadric that separates
/// what is asked from all interiors gives a row that the motion must meet, by its derivative; of all motions
/// that meet them the nearest is taken, in steps. [docs/deformation.md]
///
/// @param body     undeformed; its mesh should have no faces longer than a twentieth of it (split_edges())
/// @param problem  of the undeformed body, and of every deformed one: what it asks depends on the moments
/// @throws Interrupted
[[nodiscard]] Deformation deform(const Body& body, const Problem& problem, const ShapeRays& rays,
                                 const DeformOptions& options, device::Device& device,
                                 const Control& control = {});

}  // namespace kreisel::core
