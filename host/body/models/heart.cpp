#include "body/models/blend.hpp"
#include "body/models/drawing.hpp"
#include "body/models/shapes.hpp"

namespace kreisel {
namespace {

// Two cones that lean together, lobes above, and a third between them that ends in the tip and fills their
// seam but for the cleft on top. Drawn in millimetres; symmetric in x and in y.
double field(const Vec3& p) {
  using namespace blend;
  const Vec3 flat(p.x(), 1.08 * p.y(), p.z());
  const double lobes = join(cone(flat, Vec3(14.2, 0, 38.0), 14.6, Vec3(3.0, 0, 15.0), 9.5),
                            cone(flat, Vec3(-14.2, 0, 38.0), 14.6, Vec3(-3.0, 0, 15.0), 9.5), 6.0);
  return join(lobes, cone(flat, Vec3(0, 0, 27.5), 14.6, Vec3(0, 0, 1.8), 1.8), 8.0);
}

}  // namespace

TriangleMesh heart_shape(int fineness) {
  static const Drawing drawing{field,
                               {Vec3(-28.795, -14.152, -0.4305), Vec3(28.795, 14.152, 52.599)},
                               Vec3(57.59, 28.304, 53.0295) * (60 / 57.59),
                               0.895};
  return mesh_of(drawing, fineness);
}

}  // namespace kreisel
