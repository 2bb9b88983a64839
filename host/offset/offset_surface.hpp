// offset_surface.hpp - the surface at a distance from a closed mesh, by a level set.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// The closed surface of all points at `distance` from a solid's surface: outside it where `distance` > 0,
/// within it where < 0; empty where nothing of the solid is that deep.
///
/// The distances at the corners of cubic voxels are those of OpenVDB; between them the surface is
/// interpolated and edges are bevelled, by less than a voxel. Where it is smooth it errs by a small part of
/// one.
///
/// @param mesh      closed, up to gaps below a voxel; self-intersections are taken for what they enclose, and
///                  cavities are filled
/// @param distance  not 0, the mesh's unit
/// @param voxel     edge of a voxel, > 0, the mesh's unit; memory goes with the voxels within `distance` of
///                  the surface
/// @throws InputError  no triangles, a distance or voxel out of range (names both), more voxels than is
///                     sensible, or OpenVDB's module is not where the program looks for it
[[nodiscard]] TriangleMesh offset_surface(const TriangleMesh& mesh, double distance, double voxel);

}  // namespace kreisel::core
