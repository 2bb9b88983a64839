// octree.hpp - one fill a cell of an octree that is fine along the voids alone. [docs/octree.md]
#pragma once

#include "formulation/formulation.hpp"

namespace kreisel::core {

struct OctreeSettings {
  double gamma_l = 1e-3;           ///< weight of the regulariser at level 3; >= 0
  double epsilon = 0.01;           ///< fills nearer to 0 or 1 than this are no fractions; in (0, 0.5)
  std::optional<int> start_level;  ///< of the first leaves; nothing: half of the domain's
};

[[nodiscard]] Fields<OctreeSettings> octree_fields();

/// x[c] in [0,1] is the fill of what interior there is in leaf c; s(x) is linear. The paper's beta = 1 - x.
/// Leaves are cubes of the domain's voxels, first all of one size; refine() splits those that the optimum
/// leaves fractional or between void and solid, and merges those that agree. The regulariser is
/// gamma x^T L x / 2, L the uniform Laplacian of leaves that share a face; gamma is gamma_l at level 3, and
/// 16 times less a level further. Start: any of Start. Rounds at one half. [SpinIt, s. 5.3]
///
/// @param settings  OctreeSettings
/// @throws InputError  a first level that the domain has not
std::unique_ptr<Formulation> make_octree(const Columns& domain, const Traits& traits,
                                         const Settings& settings, device::Device& device);

}  // namespace kreisel::core
