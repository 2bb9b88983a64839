#include <array>

#include "body/models/blend.hpp"
#include "body/models/drawing.hpp"
#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

// Drawn in cells of the grid of [RayRep, table 1], 89 x 105 x 101: z up, beak towards -y; symmetric in x.
double field(const Vec3& from_behind) {
  using namespace blend;
  const Vec3 p(from_behind.x(), -from_behind.y(), from_behind.z());  // here the beak is at +y
  const Vec3 m = mirrored(p);
  double duck = join(ellipsoid(p, Vec3(12, -1, 28), Vec3(30, 45.5, 33)),
                     ellipsoid(p, Vec3(-12, -1, 28), Vec3(30, 45.5, 33)), 24);  // body
  duck = join(duck, cone(p, Vec3(0, 17, 33), 27, Vec3(0, 17, 55), 19), 10);     // breast, neck
  duck = join(duck, ball(p, Vec3(0, 15.5, 74), 27), 6);                         // head
  duck = join(duck, cone(p, Vec3(0, -30, 36), 17, Vec3(0, -41, 57), 5), 18);    // tail
  duck = join(duck, ellipsoid(m, Vec3(38, -5, 35), Vec3(6.5, 33, 15)), 3);      // wings
  const double upper = ellipsoid(p, Vec3(0, 40.5, 72.5), Vec3(17, 15, 4.4));
  const double lower = ellipsoid(p, Vec3(0, 38, 67), Vec3(12, 10, 4));
  duck = join(duck, join(upper, lower, 5), 5);               // beak
  duck = join(duck, ball(m, Vec3(12.5, 36, 84), 4.2), 1.2);  // eyes
  return meet(duck, -p.z(), 5);
}

}  // namespace

TriangleMesh duck_shape(int fineness) {
  static const Drawing drawing{
      field, {Vec3(-44.5, -55.5, 0), Vec3(44.5, 52.855, 101)}, Vec3(89, 105, 101) * (60.0 / 105), 0.79};
  return mesh_of(drawing, fineness);
}

}  // namespace kreisel::core
