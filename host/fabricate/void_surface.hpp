// void_surface.hpp - the boundary of the void voxels as a mesh.
#pragma once

#include "formulation/voxel_set.hpp"
#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// Faces between void and solid voxels, two triangles each, normals into the void (out of the material); body
/// units. Written beside the outer mesh it is a cavity: their signed volumes add up to the material.
/// Watertight; a manifold when the set is well composed. Empty when nothing is void. [RayRep, s. 3.4]
[[nodiscard]] TriangleMesh void_surface(const VoxelSet& solid);

}  // namespace kreisel::core
