// thickness.hpp - how thin the material between the surfaces of a part gets.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Where a part is thinnest.
struct ThinPlace {
  double thickness;  ///< infinite where there is none
  Vec3 at = Vec3::Zero();
};

/// The opening of a wedge, degrees: sides that make less are a wall's, more an edge's.
inline constexpr double wall_opening = 30;

/// The thinnest wall, web or pin next to a cavity: the way from the middle of a triangle of the cavity's
/// surface straight through the material to a side that faces it. Two sides face one another where they open,
/// as those of a wedge, by `wall_opening` at most, and have no corner in common: an edge gets thinner than
/// anything at its tip, and prints all the same. Walls are as thick as asked (wall.hpp says exactly); webs
/// between voids are found by this alone.
///
/// Rays in single precision find the triangle, double precision says how far it is; in the unit of the
/// meshes.
///
/// @param extent  a place counts where triangles that touch one another, all as thin as what is returned or
///                thinner, have extent^2 of area: what is smaller no printer makes
[[nodiscard]] ThinPlace thinnest_material(const TriangleMesh& outer, const TriangleMesh& cavity,
                                          double extent);

}  // namespace kreisel::core
