#include <array>

#include "body/models/blend.hpp"
#include "body/models/drawing.hpp"
#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

using blend::Bead;

// Drawn in about millimetres: z up from the foot, spout towards +x, handle towards -x; symmetric in y.

const std::array<Bead, 5> spout_beads = {{{{13.0, 0, 9.5}, 7.0},
                                          {{20.5, 0, 13.0}, 4.8},
                                          {{24.8, 0, 19.5}, 3.4},
                                          {{28.0, 0, 26.0}, 2.7},
                                          {{32.0, 0, 29.6}, 2.5}}};

/// Part of a ring that stands on edge; what of it lies in the belly changes nothing.
double handle(const Vec3& p) {
  const Vec3 q = p - Vec3(-18.5, 0, 17.5);
  const double round = std::hypot(q.x() / 1.12, q.z() / 0.95) - 9.5;
  return std::hypot(round, q.y() * 0.9) - 2.3;
}

double teapot_field(const Vec3& p) {
  using namespace blend;
  static const Tube spout(spout_beads);
  double pot = ellipsoid(p, Vec3(0, 0, 15.0), Vec3(20.0, 20.0, 15.5));
  pot = join(pot, ellipsoid(p, Vec3(0, 0, 1.0), Vec3(12.5, 12.5, 4.0)), 3.0);  // foot
  pot = spout.joined_to(pot, p, 3.0);
  pot = join(pot, handle(p), 1.6);
  const double lid = ellipsoid(p, Vec3(0, 0, 27.6), Vec3(12.2, 12.2, 4.6));
  const double knob =
      join(ball(p, Vec3(0, 0, 35.0), 3.1), cone(p, Vec3(0, 0, 30), 2.6, Vec3(0, 0, 34), 1.7), 1.0);
  pot = join(pot, join(lid, knob, 1.6), 1.2);
  return meet(pot, -p.z(), 1.6);
}

}  // namespace

TriangleMesh teapot_shape(int fineness) {
  static const Drawing drawing{teapot_field,
                               {Vec3(-31.714, -20, 0), Vec3(34.496, 20, 38.1)},
                               Vec3(66.21, 40, 38.1) * (60 / 66.21),
                               1.11};
  return mesh_of(drawing, fineness);
}

}  // namespace kreisel::core
