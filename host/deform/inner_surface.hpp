// inner_surface.hpp - the boundary of the interior, and what of the skin it hangs on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "domain/exact.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// A piece of the interior's boundary. As the skin moves with velocity v, the piece moves outward by
/// normal . v(foot), for it stays as deep as the wall: |y - x| = wall at the nearest point x of the skin,
/// also where that lies on an edge or a corner. [docs/deformation.md]
struct InnerPiece {
  Vec3 at;                            ///< y
  Vec3 normal;                        ///< (x - y) / |x - y|, out of the interior
  double area;                        ///< that it stands for
  Triangle corners;                   ///< of the skin's triangle that x lies in, by vertex
  std::array<double, 3> barycentric;  ///< of x in it
};

/// Along one axis, by the rays that the moments are summed over: an end of a ray stands for h^2 / |n_z| of
/// boundary. So the sum over the pieces is the exact derivative of the sum over these rays, as long as none
/// appears or vanishes; what of the boundary stands along the rays is missed.
[[nodiscard]] std::vector<InnerPiece> ray_ends(const TriangleMesh& skin, const ExactColumns& rays);

/// The whole boundary: ends of rays along all three axes, each of which stands for h^2 |n_a|, for n_a^2 of
/// the boundary is summed along axis a. So no direction is missed and none counts for too much.
/// @param h  pitch of the rays
[[nodiscard]] std::vector<InnerPiece> inner_surface(const TriangleMesh& skin, double wall, double h);

}  // namespace kreisel::core
