#include "body/models/blend.hpp"
#include "body/models/drawing.hpp"
#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

using namespace blend;

// Two cones that lean together, lobes above, and a third between them that ends in the tip and fills their
// seam but for the cleft on top. Drawn in millimetres; symmetric in x and in y.
double heart(const Vec3& p) {
  const Vec3 flat(p.x(), 1.08 * p.y(), p.z());
  const double lobes = join(cone(flat, Vec3(14.2, 0, 38.0), 14.6, Vec3(3.0, 0, 15.0), 9.5),
                            cone(flat, Vec3(-14.2, 0, 38.0), 14.6, Vec3(-3.0, 0, 15.0), 9.5), 6.0);
  return join(lobes, cone(flat, Vec3(0, 0, 27.5), 14.6, Vec3(0, 0, 1.8), 1.8), 8.0);
}

// A rod through the middle, a knob to twirl it by, and a head that ends in a round tip. It leans from the
// heart's thin direction, about which the heart's moment is the largest, by 19.5 degrees.
const Vec3 middle(0, 0, 31.0), along = Vec3(1, 4, 1).normalized();
constexpr double tip_at = -29.0, tip_radius = 1.6;

double heart_with_arrow(const Vec3& p) {
  const auto on_rod = [](double t) { return Vec3(middle + t * along); };
  const double head = cone(p, on_rod(-20.0), 4.5, on_rod(tip_at), tip_radius),
               rod = join(cone(p, on_rod(-26.0), 2.3, on_rod(22.0), 2.2), ball(p, on_rod(22.0), 3.4), 1.0);
  return join(join(heart(p), rod, 1.5), head, 1.0);
}

}  // namespace

TriangleMesh heart_shape(int fineness) {
  static const Drawing drawing{heart,
                               {Vec3(-28.795, -14.152, -0.4305), Vec3(28.795, 14.152, 52.599)},
                               Vec3(57.59, 28.304, 53.0295) * (60 / 57.59),
                               0.895};
  return mesh_of(drawing, fineness);
}

TriangleMesh arrow_heart_shape(int fineness) {
  static const Drawing drawing{heart_with_arrow,
                               {Vec3(-28.795, -28.9415, -0.4305), Vec3(28.795, 24.1418, 52.599)},
                               Vec3(57.59, 53.0833, 53.0295) * (60 / 57.59),
                               0.895};
  return mesh_of(drawing, fineness);
}

}  // namespace kreisel::core
