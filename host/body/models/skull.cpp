#include "body/models/blend.hpp"
#include "body/models/drawing.hpp"
#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

// Drawn in units of about a millimetre: z up, the face towards -y; symmetric in x. Sockets and nose are
// shallow, so that it is nearly convex, as a sugar skull is.
double skull_field(const Vec3& p) {
  using namespace blend;
  const Vec3 m = mirrored(p);
  const double cranium = ellipsoid(p, Vec3(0, 5, 37), Vec3(24, 29, 25));
  const double jaw = cone(p, Vec3(0, -8, 22), 17, Vec3(0, -13, 9), 13);
  const double cheek = ball(m, Vec3(14, -13, 25), 9);
  double skull = join(join(cranium, jaw, 14), cheek, 8);
  skull = meet(skull, -ellipsoid(m, Vec3(9.5, -28, 32), Vec3(6.5, 6, 6)), 4);
  skull = meet(skull, -ellipsoid(p, Vec3(0, -29, 21), Vec3(3, 4, 4.5)), 3);
  return meet(skull, -p.z(), 4);
}

}  // namespace

TriangleMesh skull_shape(int fineness) {
  static const Drawing drawing{skull_field,
                               {Vec3(-23.9789, -26.78184, 0), Vec3(23.9789, 34, 62)},
                               Vec3(47.9578, 60.78184, 62) * (60.0 / 62),
                               0.8};
  return mesh_of(drawing, fineness);
}

}  // namespace kreisel::core
