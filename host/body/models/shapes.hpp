// shapes.hpp - the shapes behind models(). All lengths in millimetres.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace kreisel::core {

/// @throws InputError  not from 1 to `finest`
void require_fineness(int fineness, int finest);

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

/// Three equal balls in a box of 30.3 x 60 x 60 mm, the grid of [RayRep, table 1], in a row along the
/// diagonal of its yz-plane: their union, with no faces inside and its seams on mesh edges.
/// @param fineness  1 to 9000
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh spheres_shape(int fineness);

/// The box [0, 60] x [0, 40] x [0, 30] mm, exact at any fineness; two triangles for each of its squares.
/// @param fineness  1 to 1000; 216 k^2 triangles, k = 0.30 fineness rounded and at least 1
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh cuboid_shape(int fineness);

/// A Turk's head of three strands, all one knotted tube of 5.4 mm, lying flat: 60 x 58.9 x 13.8 mm.
/// @param fineness  1 to 4000; below 12 the length is divided as at 12
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh woven_ring_shape(int fineness);

/// Heart of 60 x 29.5 x 55.2 mm, its tip below in the middle; symmetric in x and y.
/// @param fineness  1 to 300; below 30 as 30
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh heart_shape(int fineness);

/// The same heart with an arrow through it, 60 x 55.3 x 55.2 mm: along (1, 4, 1) from the knob to the tip,
/// which is in front and half way up.
/// @param fineness  1 to 300; below 30 as 30
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh arrow_heart_shape(int fineness);

/// Two that dance, 60 x 53.1 x 49.2 mm: one on his toes, the other bent back in his arm towards +x.
/// @param fineness  1 to 300; below 30 as 30
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh dancers_shape(int fineness);

/// Teapot of 60 x 36.2 x 34.5 mm, all solid, on a flat foot; spout towards +x, handle (genus 1) towards -x,
/// symmetric in y.
/// @param fineness  1 to 300; below 30 as 30
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh teapot_shape(int fineness);

/// Bath duck of 50.9 x 60 x 57.7 mm, the grid of [RayRep, table 1]; beak towards -y, a flat spot under the
/// belly, symmetric in x. The surface is our own.
/// @param fineness  1 to 300; below 30 as 30
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh duck_shape(int fineness);

/// Kitten of 39.4 x 35.8 x 60 mm, the grid of [RayRep, table 1], that sits on a flat base and looks towards
/// -y; its tail runs round its left side back into the body (genus 1). The surface is our own.
/// @param fineness  1 to 300; below 30 as 30
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh kitten_shape(int fineness);

/// Skull of 46.4 x 58.8 x 60 mm without a jaw of its own: shallow sockets, nearly convex, flat below; faces
/// -y, symmetric in x.
/// @param fineness  1 to 300; below 30 as 30
/// @throws InputError  fineness out of range
[[nodiscard]] TriangleMesh skull_shape(int fineness);

/// The point from which every ray meets the bird's surface once, mm.
[[nodiscard]] Vec3 bird_centre();

/// Positive inside the bird, negative outside, without unit; zero on the surface. Point in mm.
[[nodiscard]] double bird_field(const Vec3& point);

}  // namespace kreisel::core
