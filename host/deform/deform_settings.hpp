// deform_settings.hpp - what of a deformation can be set.
#pragma once

#include "settings/settings.hpp"

namespace kreisel::core {

/// Control points of a B-spline lattice, or the corners of a cage. [docs/deformation.md]
enum class HandleKind { lattice, cage };

struct DeformSettings {
  HandleKind handles = HandleKind::lattice;
  int level = 2;          ///< of the cage's cells: 2^level along the longest side
  int grid = 4;           ///< of the cells that its weights are solved for on, at least as fine
  double gamma_dl = 1;    ///< weight of the surface's bending, of cells and handles together; >= 0
  double gamma_dv = 100;  ///< of its displacement, > 0
};

/// Group "deform".
[[nodiscard]] const SettingTable& deform_settings();

/// @param given  without their group
/// @throws InputError  unknown or unfit ones
[[nodiscard]] DeformSettings parse_deform_settings(const SettingTexts& given);

}  // namespace kreisel::core
