// lay_flat.hpp - pieces beside each other, each on its cut, as they are printed.
#pragma once

#include <vector>

#include "fabricate/parts.hpp"

namespace kreisel::core {

/// Sets where each part is written: turned so that its cut lies at z = 0, a part without a cut as it stands
/// on its lowest point, one beside the other along x.
/// @param gap  between them, mm
void lay_flat(std::vector<MaterialPart>& parts, double gap = 5);

/// The surfaces of a part where it is written. Corners of its cut lie at z = 0 exactly, whatever single
/// precision made of them in model coordinates.
[[nodiscard]] std::vector<TriangleMesh> laid_surfaces(const MaterialPart& part);

}  // namespace kreisel::core
