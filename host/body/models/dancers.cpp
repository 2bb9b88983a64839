#include <array>

#include "body/models/blend.hpp"
#include "body/models/drawing.hpp"
#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

using namespace blend;

/// A limb, or part of a trunk: the hull of two balls.
struct Bone {
  Vec3 from;
  double thick;
  Vec3 to;
  double thin;
};

// A pair that dances: one on the toes of one foot, at the origin, the other bent far back in his arm. Drawn
// in millimetres, z up, her side towards +x. The poses are our own, in the spirit of the pair in [SpinIt,
// fig. 11].
const std::array<Bone, 13> leading = {{
    {{0.0, 0.0, 1.3}, 1.3, {-1.2, 0.3, 4.5}, 2.2},           // toes
    {{-1.2, 0.3, 4.5}, 2.2, {1.0, 1.0, 12.0}, 3.1},          // shin
    {{1.0, 1.0, 12.0}, 3.1, {-4.5, 2.0, 20.0}, 4.2},         // thigh
    {{-6.5, -3.0, 20.0}, 4.1, {-14.0, -12.0, 16.0}, 3.0},    // the other leg, stretched back
    {{-14.0, -12.0, 16.0}, 3.0, {-20.0, -19.0, 13.0}, 2.1},  //
    {{-20.0, -19.0, 13.0}, 2.1, {-22.0, -21.5, 11.5}, 1.5},  //
    {{-5.5, -0.5, 21.5}, 5.2, {-8.5, 0.0, 32.0}, 5.6},       // trunk
    {{-8.5, 4.5, 33.5}, 3.1, {-8.5, -4.5, 33.5}, 3.1},       // shoulders
    {{-8.8, 0.0, 34.5}, 2.4, {-9.5, 0.5, 40.0}, 4.2},        // head
    {{-8.0, 6.0, 33.0}, 2.4, {0.0, 12.0, 28.0}, 2.1},        // the arm that holds her
    {{0.0, 12.0, 28.0}, 2.1, {10.0, 6.5, 25.0}, 2.0},        //
    {{-8.5, -6.0, 33.5}, 2.4, {-5.0, -16.0, 33.0}, 2.1},     // the arm that leads
    {{-5.0, -16.0, 33.0}, 2.1, {5.0, -20.0, 32.0}, 1.9},     //
}};
const std::array<Bone, 10> following = {{
    {{6.0, 0.5, 19.5}, 4.6, {16.5, 1.0, 24.0}, 4.4},      // trunk, bent back
    {{17.5, 4.5, 24.5}, 2.7, {17.5, -3.5, 24.5}, 2.7},    // shoulders
    {{19.5, 0.8, 25.0}, 2.1, {26.5, 1.5, 26.0}, 3.9},     // head
    {{6.5, -1.5, 15.0}, 2.9, {5.5, -4.0, 6.0}, 1.9},      // the leg that she stands on
    {{5.5, -4.0, 6.0}, 1.9, {4.5, -4.5, 3.0}, 1.4},       //
    {{9.0, 4.0, 17.0}, 3.6, {14.0, 13.0, 16.0}, 2.8},     // the leg that she lifts
    {{14.0, 13.0, 16.0}, 2.8, {18.0, 23.0, 17.0}, 1.7},   //
    {{17.5, -4.5, 24.5}, 2.1, {13.5, -14.0, 29.0}, 1.9},  // the arm that is led
    {{13.5, -14.0, 29.0}, 1.9, {5.0, -20.0, 32.0}, 1.9},  //
    {{17.5, 5.0, 24.0}, 2.1, {25.0, 13.0, 22.0}, 1.6},    // the arm that falls
}};

double dancers(const Vec3& p) {
  const auto figure = [&](const auto& bones) {
    constexpr double soft = 2.0;
    double field = 1e300;
    for (const Bone& b : bones) field = join(field, cone(p, b.from, b.thick, b.to, b.thin), soft);
    return field;
  };
  const double skirt = ellipsoid(p, Vec3(6.0, 0.0, 15.0), Vec3(13.0, 14.0, 3.6));
  return join(figure(leading), join(figure(following), skirt, 2.0), 1.0);
}

}  // namespace

TriangleMesh dancers_shape(int fineness) {
  static const Drawing drawing{dancers,
                               {Vec3(-23.5, -23.0, 0.0), Vec3(30.41, 24.71, 44.21)},
                               Vec3(53.91, 47.71, 44.21) * (60 / 53.91),
                               0.98};
  return mesh_of(drawing, fineness);
}

}  // namespace kreisel::core
