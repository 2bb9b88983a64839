// deform_cells.hpp - a body deformed as published: handles and fills in one optimisation. [SpinIt, s. 6]
#pragma once

#include "control.hpp"
#include "deform/deform_settings.hpp"
#include "deform/deformation.hpp"
#include "domain/columns.hpp"
#include "solve/solver.hpp"

namespace kreisel::core {

/// What is to be solved, and by whom.
struct HandledQuestion {
  std::string formulation;  ///< octree or voxel
  SettingTexts settings;    ///< of the formulation
  const SolverEntry& solver;
  SolverOptions options;
  int resolution;  ///< voxels along the longest side at the least: it is rounded up to a power of two
  Wall wall;
};

/// Minimises the problem's objective over the fills of cells and the handles of a cage, with the regularisers
/// of both (HandledCells), to where no cell is to be split. The interior deforms with the body, its wall,
/// too: whether an interior of the whole wall does what was asked is for others to see.
///
/// @param body  undeformed; its mesh should have no faces longer than a twentieth of it
/// @throws InputError   a formulation without cells; a resolution that is coarser than the cage's grid
/// @throws Interrupted
[[nodiscard]] Deformation deform_cells(const Body& body, const Problem& problem,
                                       const HandledQuestion& question, const DeformSettings& settings,
                                       device::Device& device, const Control& control = {});

}  // namespace kreisel::core
