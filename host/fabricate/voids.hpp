// voids.hpp - how many pieces the void has, what lies loose in them, and how to get at them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "body/body.hpp"
#include "geometry/plane.hpp"

namespace kreisel::core {

/// A plane that opens what it runs through.
struct Cut : Plane {
  std::size_t opens = 0;  ///< void pieces that no earlier cut opens
};

/// Of a part with its cavities. Lengths in the unit of the mesh.
struct Voids {
  std::vector<double> pieces;   ///< volume of each connected void, the largest first
  std::vector<double> islands;  ///< of each solid piece that hangs in a void without touching the rest
  std::vector<Cut> cuts;        ///< planes that together open every void: no more than this many are needed

  /// "2 voids of 812 and 3.1 mm^3, opened by 1 cut: 0,0,1 . x = 12.5"; the mesh in millimetres.
  [[nodiscard]] std::string text() const;
};

/// Across what a part may be cut: the model's own axes, and the principal ones of the solid; model
/// coordinates.
[[nodiscard]] std::vector<Vec3> cut_directions(const Body& body);

/// Counts the shells of a part's surface: those that face inward bound the voids, those that face outward
/// inside a void are islands. In voxels whose surface is a manifold these are the pieces that hang together
/// by faces.
///
/// The cuts are chosen greedily: each is the plane across one of `directions` that runs through most voids
/// not yet open, of several the one with most room on both sides. [SpinIt, table 1, whose cuts were placed by
/// hand]
///
/// @param parts       the outer surface and the cavities, as one part (normals out of the material)
/// @param directions  not zero, at least one where there is a void
[[nodiscard]] Voids find_voids(const std::vector<TriangleMesh>& parts, std::span<const Vec3> directions);

/// The surfaces of a cavity that enclose at least so much; what is smaller is no void any more, or no island.
[[nodiscard]] TriangleMesh without_small_shells(const TriangleMesh& cavity, double least_volume);

}  // namespace kreisel::core
