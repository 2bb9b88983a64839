#include <array>

#include "body/models/blend.hpp"
#include "body/models/drawing.hpp"
#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

using blend::Bead;

// Drawn in cells of the grid of [RayRep, table 1], 101 x 92 x 154: z up, the face towards -y.

/// Out of the back, round the left side, up, and into the haunch: a loop one can put a finger through.
const std::array<Bead, 9> tail_beads = {{{{10, 32, 12}, 9},
                                         {{24, 37, 10}, 8.5},
                                         {{37, 35, 10}, 8},
                                         {{47, 27, 13}, 7.5},
                                         {{51.5, 14, 22}, 7},
                                         {{51.5, 3, 34}, 6.6},
                                         {{47, -2, 45}, 6.2},
                                         {{39, -2, 53}, 6},
                                         {{28, 3, 57}, 6}}};

double head(const Vec3& p, const Vec3& m) {
  using namespace blend;
  double f = ellipsoid(p, Vec3(0, -13, 119), Vec3(33, 27, 26));
  f = join(f, ellipsoid(m, Vec3(7, -35, 109), Vec3(10, 10, 8)), 6);           // cheeks
  f = join(f, ball(p, Vec3(0, -42, 114), 3.5), 3);                            // nose
  f = join(f, cone(m, Vec3(20, -11, 132), 10.5, Vec3(28, -9, 151), 2.6), 5);  // ears
  f = join(f, ball(m, Vec3(12.5, -36, 122), 4.6), 1.5);                       // eyes
  return f;
}

double kitten_field(const Vec3& p) {
  using namespace blend;
  static const Tube tail(tail_beads);
  const Vec3 m = mirrored(p);
  double cat = ellipsoid(p, Vec3(0, 12, 30), Vec3(33, 34, 33));               // rump
  cat = join(cat, cone(p, Vec3(0, 6, 40), 32, Vec3(0, -10, 84), 22), 10);     // back, chest
  cat = join(cat, cone(p, Vec3(0, -16, 62), 19, Vec3(0, -17, 10), 15), 6);    // belly
  cat = join(cat, ellipsoid(m, Vec3(24, 6, 25), Vec3(15, 27, 25)), 6);        // thighs
  cat = join(cat, cone(m, Vec3(13, -22, 62), 12, Vec3(13, -29, 8), 8.5), 5);  // front legs
  cat = join(cat, ellipsoid(m, Vec3(11, -34, 6), Vec3(8.5, 13, 8)), 3);       // front paws
  cat = join(cat, ellipsoid(m, Vec3(35.5, -18, 6), Vec3(7.5, 18, 8.5)), 3);   // hind paws
  cat = tail.joined_to(cat, p, 4);
  cat = join(cat, head(p, m), 8);
  return meet(cat, -p.z(), 2);
}

}  // namespace

TriangleMesh kitten_shape(int fineness) {
  static const Drawing drawing{kitten_field,
                               {Vec3(-43, -47, 0), Vec3(58.872, 46.018, 153.593)},
                               Vec3(101, 92, 154) * (60.0 / 154),
                               0.93};
  return mesh_of(drawing, fineness);
}

}  // namespace kreisel::core
