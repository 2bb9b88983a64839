// quadric_cavity.hpp - the void that a quadric leaves of an interior, as a mesh.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "body/body.hpp"
#include "geometry/triangle_mesh.hpp"
#include "mesh/make/march.hpp"
#include "mesh/query/distance.hpp"

namespace kreisel::core {

/// Meshes the boundary of { depth >= wall, q >= 0 }: everything of the interior that a quadric does not fill.
///
/// Marching tetrahedra on a body-centred cubic lattice; which of its points lie in the void comes from the
/// exact offset along the lattice's vertical lines (mesh/query/offset.hpp), and every vertex is moved along
/// its edge of the lattice onto the surface: the quadric's root in closed form, the depth by exact distances;
/// where the two meet, the mesh has an edge (mesh/make/crease.hpp). So the mesh is a manifold that does not
/// run through itself, and its moments converge to those of the rays (domain/exact.hpp) as cell^2. Parts
/// thinner than a cell may be lost; what lies within a thousandth of a cell of the surface at a point of the
/// lattice is left to the material.
///
/// No point of the mesh is nearer to the body's surface than wall - 1e-7 cell: vertices are laid
/// sqrt(wall^2 + cell^2 / 3) + spare deep, and by Steiner's parallel axis theorem a triangle without an edge
/// longer than a cell is nowhere nearer than the wall and the spare, then.
class CavityMesher {
 public:
  /// @param body  outlives the mesher
  /// @param wall  body units
  /// @param cell  edge of the lattice's cubes, body units
  /// @param spare  how far the mesh may be moved towards the body's surface afterwards, body units
  /// @throws InputError  not 0 < cell <= wall; more than 1024 cells along the longest side; a body that is
  ///                     not closed; an interior without a point of the lattice
  CavityMesher(const Body& body, double wall, double cell, double spare = 0);

  /// @param q  coefficients of 1 x y z xy yz xz xx yy zz, body frame and units
  /// @return   normals into the void (out of the material), body frame and units, as void_surface(): written
  ///           beside the outer mesh it is a cavity. Empty when nothing is void.
  /// Not from several threads at once: what one mesh needed of depths serves the next.
  [[nodiscard]] TriangleMesh operator()(const Moments& q) const;

  /// Whether a point is as deep as the vertices along the wall.
  [[nodiscard]] bool deep(const Vec3& p) const { return deeper(p, depth_); }
  [[nodiscard]] bool deeper(const Vec3& p, double depth) const { return distance_(p, depth) >= depth; }

 private:
  const Body& body_;
  double depth_;  ///< of vertices
  CubicLattice lattice_;
  std::vector<bool> deep_;  ///< points of the lattice
  SurfaceDistance distance_;
  /// Where edges of the lattice reach the depth, as shares of them: the same for every quadric.
  mutable std::unordered_map<std::uint64_t, double> reached_;
};

/// One mesh by a mesher of its own.
[[nodiscard]] TriangleMesh quadric_cavity(const Body& body, double wall, const Moments& q, double cell);

}  // namespace kreisel::core
