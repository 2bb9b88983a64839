// loose_pieces.hpp - what somebody holds in the hand after a cut.
#pragma once

#include <vector>

#include "fabricate/parts.hpp"

namespace kreisel::core {

/// The volumes of the connected pieces of material, the largest first, cubed units of the meshes. A half of a
/// cut may be several: two ears and a head.
/// @param parts  closed surfaces each, outward, their cavities inward
[[nodiscard]] std::vector<double> loose_pieces(const std::vector<MaterialPart>& parts);

}  // namespace kreisel::core
