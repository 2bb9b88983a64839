#include "fabricate/swept_void.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/mesh_moments.hpp"
#include "mesh/query/distance.hpp"
#include "mesh/shapes.hpp"
#include "mesh/solid/check.hpp"
#include "mesh/solid/self_intersections.hpp"

namespace kreisel::core {
namespace THIS_FILE {

/// Sound: closed, outward when turned over, and not running through itself.
void expect_solid(const TriangleMesh& void_of) {
  const TriangleMesh solid = inverted(void_of);
  EXPECT_NO_THROW(require_solid(solid, "void"));
  EXPECT_TRUE(self_intersections(solid).empty());
}

double volume(const TriangleMesh& void_of) { return -reference::mesh_moments(void_of).value[S1]; }

/// Least distance of a shape's points, and of their ways back to the cut, from a surface.
double gap(const TriangleMesh& shape, const TriangleMesh& surface, const WayOff& way) {
  const SurfaceDistance distance(surface);
  double least = 1e9;
  for (const Vec3& v : shape.vertices) {
    const double beyond = way.normal.dot(v) - way.offset;
    if (beyond < 0) continue;
    const double length = beyond / way.normal.dot(way.direction);
    for (int k = 0; k <= 8; ++k) least = std::min(least, distance(v - length * k / 8 * way.direction, 10));
  }
  return least;
}

TEST(SweptVoid, OfABoxIsTheBoxWithRoundedEdgesStraightDownToTheCut) {
  const TriangleMesh box = box_mesh({-2, -3, -1}, {2, 3, 4});
  const double clearance = 0.3, pixel = 0.05, below = 0.5, radius = clearance + 1.5 * pixel;
  const WayOff way{Vec3::UnitZ(), 0, Vec3::UnitZ()};
  const TriangleMesh found = swept_void(box, way, clearance, pixel, below);
  expect_solid(found);
  // Steiner's formula for the upper part; down to the bottom the outline's area.
  const double pi = std::numbers::pi, area = 24 + 20 * radius + pi * radius * radius;
  const double expected = (24 * 4 + 24 * radius) + 4 * (20 * radius + pi * radius * radius) +
                          20 * pi * radius * radius / 4 + 2 * pi / 3 * radius * radius * radius +
                          below * area;
  // The outline keeps a tenth of a pixel clear of the grid's corners, and chords cut a bit off the arcs.
  EXPECT_NEAR(volume(found), expected, (20 + 2 * pi * radius) * (4 + radius + below) * 0.15 * pixel);
  EXPECT_GE(gap(box, found, way), clearance);
  const Box bounds = bounding_box(found);
  EXPECT_NEAR(bounds.hi[2], 4 + radius, 1e-9);
  EXPECT_NEAR(bounds.lo[2], -below, 1e-9);
  EXPECT_NEAR(bounds.hi[0], 2 + radius, pixel);
}

TEST(SweptVoid, KeepsClearOfAnyShapeOnAnyWayAndNotMuchFarther) {
  Random random(3);
  const TriangleMesh shape = moved(torus(48, 24), random_rotation(random), Vec3::Zero());
  for (int i = 0; i < 6; ++i) {
    const Vec3 normal = random_vec(random, -1, 1).normalized();
    const Vec3 direction = (normal + random_vec(random, -0.5, 0.5)).normalized();
    const WayOff way{normal, uniform(random, -2, 2), direction};
    const double clearance = uniform(random, 0.1, 0.4), pixel = clearance / 4;
    const TriangleMesh found = swept_void(shape, way, clearance, pixel, 1);
    expect_solid(found);
    EXPECT_GE(gap(shape, found, way), clearance);
    // Every vertex beyond the cut has the shape or its way within the radius and a pixel's diagonal.
    const SurfaceDistance distance(shape);
    const double most = clearance + (1.5 + std::numbers::sqrt2) * pixel;
    for (std::size_t v = 0; v < found.vertices.size(); v += 7) {
      const Vec3& from = found.vertices[v];
      if (way.normal.dot(from) - way.offset < 0) continue;
      double least = most + 1;
      for (double t = 0; t < 9 && least > most; t += pixel / 4)
        least = std::min(least, distance(from + t * direction, most + 1));
      EXPECT_LE(least, most);
    }
  }
}

TEST(SweptVoid, ReachesAsHighAsASpikeThinnerThanAPixel) {
  TriangleMesh spike;
  spike.vertices = {{0.013, 0.01, 0}, {0.014, 0.01, 0}, {0.013, 0.011, 0}, {0.0132, 0.0102, 2}};
  spike.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const WayOff way{Vec3::UnitZ(), 0.5, Vec3::UnitZ()};
  const TriangleMesh found = swept_void(spike, way, 0.4, 0.1, 1);
  expect_solid(found);
  EXPECT_GE(gap(spike, found, way), 0.4);
}

TEST(SweptVoid, IsEmptyWhereTheShapeStaysOnTheOtherSide) {
  const TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 0});
  EXPECT_TRUE(swept_void(box, {Vec3::UnitZ(), 0.6, Vec3::UnitZ()}, 0.4, 0.1, 0.2).triangles.empty());
  // Nearer than the clearance it needs room.
  EXPECT_FALSE(swept_void(box, {Vec3::UnitZ(), 0.3, Vec3::UnitZ()}, 0.4, 0.1, 0.2).triangles.empty());
}

TEST(SweptVoid, IsTheSameEveryTime) {
  const TriangleMesh shape = torus(24, 12);
  const WayOff way{Vec3::UnitZ(), 0.2, Vec3::UnitZ()};
  const TriangleMesh one = swept_void(shape, way, 0.4, 0.1, 0.2),
                     other = swept_void(shape, way, 0.4, 0.1, 0.2);
  EXPECT_EQ(one.vertices, other.vertices);
  EXPECT_EQ(one.triangles, other.triangles);
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
