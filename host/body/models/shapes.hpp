// shapes.hpp - the shapes behind models(). All lengths in millimetres.
#pragma once

#include "mesh/triangle_mesh.hpp"

namespace kreisel {

/// Ellipsoid in a box of 60 x 39 x 38.25 mm with its corner at the origin, its long axis tilted by 6 degrees
/// about y: the lowest point lies 3 mm from the vertical through the centroid, so the solid cannot spin on
/// it. In a grid of 80 x 52 x 51 cells it holds about the voxel and column counts of [RayRep, table 2].
/// @param fineness  >= 1; 20 fineness^2 triangles
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh ellipsoid_shape(int fineness);

/// Plump bird of 60 x 45 x 45 mm with its box's corner at the origin: beak towards +x and turned to +y, wings
/// along y, z up. A smooth union of ellipsoids, star-shaped about bird_centre(). Its counts and proportions
/// follow the bird of [RayRep, table 2]; the surface is our own.
/// @param fineness  >= 1; 20 fineness^2 triangles
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh bird_shape(int fineness);

/// The point from which every ray meets the bird's surface once, mm.
[[nodiscard]] Vec3 bird_centre();

/// Positive inside the bird, negative outside, without unit; zero on the surface. Point in mm.
[[nodiscard]] double bird_field(const Vec3& point);

}  // namespace kreisel
