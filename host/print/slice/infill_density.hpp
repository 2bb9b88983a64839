// infill_density.hpp - how much of what is full there is where infill is sparse: measured, never assumed.
#pragma once

#include <string>
#include <vector>

#include "print/slice/slice.hpp"

namespace kreisel::core {

/// One cube with a core of infill, beside the same cube filled.
struct InfillBlock {
  double edge = 0;   ///< of the core, mm
  double share = 0;  ///< of what is full that is printed within the core
};

/// Sparse infill weighs what its lines do, and something more along its boundary: walls of what is full
/// around it, and layers that bridge it. So a region of volume V and surface A holds bulk + skin A / V of
/// what would be printed there if it were full.
struct InfillDensity {
  double bulk = 0;  ///< share
  double skin = 0;  ///< mm
  std::string slicer;
  std::vector<InfillBlock> blocks;  ///< that say so
  bool remembered = false;          ///< they were sliced earlier

  /// Of a region. @param volume, surface  mm^3, mm^2
  [[nodiscard]] double share(double volume, double surface) const { return bulk + skin * surface / volume; }
};

/// Slices three test blocks, full and with a core, by the profile that the specification has; or finds them
/// in the cache of the user, by profile, slicer's version, share and pattern.
/// @param spec  with infill  @throws InputError  as MeshSlicer; blocks that say nothing of the kind
/// @throws Interrupted
[[nodiscard]] InfillDensity measure_infill(const SliceSpec& spec, const Control& control);

}  // namespace kreisel::core
