// parting.hpp - in which direction the two halves of a mould come off a casting.
#pragma once

#include "geometry/plane.hpp"

namespace kreisel::core {

/// A flat parting: the halves of a mould meet in the plane and are drawn apart along its normal, of length 1.
struct Parting : Plane {
  /// How much of the mould a casting holds back: what of either half has casting in front of it, cubed units
  /// of the mesh. 0: the halves come off; else they must give way, or break.
  double undercut = 0;
};

/// The parting with the least undercut, of some hundred directions, by rays on a grid: for each the best of
/// the heights, and of equal ones that nearest to the middle.
/// @param casting  a closed surface
[[nodiscard]] Parting least_undercut(const TriangleMesh& casting);

/// How much a parting holds back. @param rays  across the casting's longer side
[[nodiscard]] double undercut(const TriangleMesh& casting, const Vec3& normal, double offset, int rays = 96);

}  // namespace kreisel::core
