// quadric_cavity.hpp - the void that a quadric leaves of an interior, as a mesh.
#pragma once

#include "body/body.hpp"
#include "mesh/triangle_mesh.hpp"

namespace kreisel {

/// The boundary of { depth >= wall, q >= 0 }: everything of the interior that the quadric does not fill.
///
/// Marching tetrahedra on a body-centred cubic lattice; which of its points lie in the void comes from the
/// exact offset along the lattice's vertical lines (mesh/offset.hpp), and every vertex is moved along its
/// edge of the lattice onto the surface: the quadric's root in closed form, the depth by exact distances. So
/// the mesh is a manifold that does not run through itself, and its moments converge to those of the rays
/// (domain/exact.hpp) as cell^2. Parts thinner than a cell may be lost; what lies within a hundredth of a
/// cell of the surface at a point of the lattice is left to the material.
///
/// No vertex is nearer to the body's surface than wall - 1e-7 cell; no other point of the mesh than
/// sqrt(wall^2 - cell^2 / 3), less as much: by Steiner's parallel axis theorem, as no triangle has an edge
/// longer than a cell.
///
/// @param wall  body units
/// @param q     coefficients of 1 x y z xy yz xz xx yy zz, body frame and units
/// @param cell  edge of the lattice's cubes, body units
/// @return      normals into the void (out of the material), body frame and units, as void_surface(): written
///              beside the outer mesh it is a cavity. Empty when nothing is void.
/// @throws InputError  not 0 < cell <= wall: facets would come too near to the surface; more than 1024 cells
///                     along the longest side; a body that is not closed
[[nodiscard]] TriangleMesh quadric_cavity(const Body& body, double wall, const Moments& q, double cell);

}  // namespace kreisel
