// drain.hpp - holes from the voids to the outside, for what a printer leaves in them.
#pragma once

#include <vector>

#include "control.hpp"
#include "fabricate/parts.hpp"

namespace kreisel::core {

/// Where a hole is drilled: from a point of the outer surface inwards.
struct Drain {
  Vec3 from;   ///< model coordinates, mm
  Vec3 along;  ///< unit vector into the material
};

/// A place for each void: of the points where it is within a tenth of the wall of as near to the outside as
/// it comes, and both surfaces are even over the hole's width, the lowest along `up`; straight out from
/// there. Those without such a place are left out. No more than 50 places are drilled for a void, evenly from
/// its lowest point to its highest.
///
/// @param outer   of the part; model coordinates, mm
/// @param cavity  of the part, normals into the voids
/// @param radius  of the holes, mm
[[nodiscard]] std::vector<Drain> drains_of(const TriangleMesh& outer, const TriangleMesh& cavity,
                                           double radius, const Vec3& up, const Control& control = {});

/// The part with holes through its wall: outer surface, voids and the holes' walls as one surface. A hole is
/// as round as triangles of a third of its radius make it, and its rims lie on both surfaces.
///
/// @throws InputError  a hole that would not be one: a surface that is uneven there, or none behind the other
[[nodiscard]] TriangleMesh drained(const TriangleMesh& outer, const TriangleMesh& cavity,
                                   const std::vector<Drain>& drains, double radius);

}  // namespace kreisel::core
