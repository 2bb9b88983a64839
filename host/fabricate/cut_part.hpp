// cut_part.hpp - a part cut by planes, so that its voids open.
#pragma once

#include <span>
#include <vector>

#include "fabricate/parts.hpp"
#include "geometry/plane.hpp"

namespace kreisel::core {

/// Loose pins that align two halves: each sits in a hole in either.
struct Pegs {
  double radius = 0;  ///< of the holes, mm; 0: none
  static constexpr int sides = 24;
  /// By how much less the pins' radius and half their length are, mm. Holes and pins are 24-sided prisms.
  static constexpr double clearance = 0.1;
  [[nodiscard]] double depth() const { return 2 * radius; }  ///< of each hole
};

/// What the planes, one after the other, leave of a part: an upper and a lower half (seen along the normal)
/// of one plane, pieces with numbers of several; where they were, in model coordinates. Flat caps close them.
/// Pegs are parts of their own, two where the cut has room for two: of the places with half a radius of
/// material around the hole, those farthest from each other.
///
/// A plane is moved by up to a thousandth of the part's size to where it keeps clear of all corners, and all
/// coordinates are in single precision, so that no file format makes a cap's slivers fold.
///
/// @throws InputError  a plane that misses the part; pegs and several planes, or no room for a peg
[[nodiscard]] std::vector<MaterialPart> cut_part(const MaterialPart& part, std::span<const Plane> planes,
                                                 const Pegs& pegs = {});

/// What each half of a solid has to leave free: closed surfaces that go on beyond the plane, normals into the
/// void; either may be empty.
struct HalfVoids {
  TriangleMesh upper, lower;
};

/// The upper and the lower half of a solid, each without a void of its own, and pegs; otherwise as
/// cut_part().
///
/// @param solid  model coordinates, mm; free of voids, as long as those keep within it on their side
/// @throws InputError  a plane that misses the solid, no room for a peg
[[nodiscard]] std::vector<MaterialPart> cut_in_halves(const TriangleMesh& solid, const HalfVoids& voids,
                                                      const Plane& plane, double density,
                                                      const Pegs& pegs = {});

}  // namespace kreisel::core
