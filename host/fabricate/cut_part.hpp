// cut_part.hpp - a part cut by planes, so that its voids open.
#pragma once

#include <span>
#include <vector>

#include "fabricate/parts.hpp"
#include "fabricate/voids.hpp"

namespace kreisel {

/// What the planes, one after the other, leave of a part: an upper and a lower half (seen along the normal)
/// of one plane, pieces with numbers of several; where they were, in model coordinates. Flat caps close them.
///
/// A plane is moved by up to a thousandth of the part's size to where it keeps clear of all corners, and all
/// coordinates are in single precision, so that no file format makes a cap's slivers fold.
///
/// @throws InputError  a plane that misses the part
[[nodiscard]] std::vector<MaterialPart> cut_part(const MaterialPart& part, std::span<const Cut> planes);

}  // namespace kreisel
