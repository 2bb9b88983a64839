// parts.hpp - of what solids a finished part consists, one a material. [docs/materials.md]
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "body/body.hpp"
#include "fabricate/quadric_cavity.hpp"
#include "formulation/voxel_set.hpp"

namespace kreisel::core {

/// What is inside a body's outer surface; body frame and units.
struct Inside {
  TriangleMesh voids;  ///< boundary of the voids, normals into them
  /// Where shell and interior are of two materials, else empty: the boundary of the whole interior, normals
  /// into it, and that of what is no void of it, normals out of it.
  TriangleMesh interior, fill;
};

/// Everything of one material. Normals out of it.
struct MaterialPart {
  std::string name;                    ///< part; or shell, interior; and filling, of voids that are not empty
  double density = 1;                  ///< g/cm^3
  std::vector<TriangleMesh> surfaces;  ///< its outer surface, and its cavities as surfaces of their own
  Vec3 down = Vec3::Zero();            ///< out of the cut that it can lie on; zero: it has none
  Vec3 place = Vec3::Zero();           ///< near it, where it is far from the origin (place_of())
  /// From model coordinates to where it is written (lay_flat.hpp).
  Eigen::Affine3d laid = Eigen::Affine3d::Identity();
};

/// An interior of whole voxels. Where a surface would meet itself along an edge, each side has vertices of
/// its own. @param heavy  what a formulation leaves solid (MassModel): the interior, or heavy voids
[[nodiscard]] Inside inside_of(const Body& body, const VoxelSet& heavy);

/// An interior of the exact domain, cut by a quadric that is negative where the heavier material goes. The
/// surfaces are meshed one by one and differ where they meet by what the mesh differs from the quadric.
/// @param mesh  of the same body
[[nodiscard]] Inside inside_of(const Body& body, const CavityMesher& mesh, const Moments& q);

/// Total moments, body frame and units; the voids hold their filling, if any.
[[nodiscard]] Moments moments_of(const Body& body, const Inside& inside);

/// The same of solids in model coordinates, mm, with what is added to the body.
[[nodiscard]] Moments moments_of(const Body& body, const std::vector<MaterialPart>& parts);

/// The solids to make: the part with its cavities, or a shell and an interior; and a filling of the voids.
/// Those without a surface are left out. Model coordinates, mm.
[[nodiscard]] std::vector<MaterialPart> parts_of(const Body& body, const Inside& inside);

}  // namespace kreisel::core
