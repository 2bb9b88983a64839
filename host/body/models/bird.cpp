#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "body/models/geodesic.hpp"
#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

// The bird is drawn in units of about 2/3 mm, roughly one cell of the 80 x 60 x 60 grid of [RayRep, table 2],
// around its centre. The numbers marked "fit" come from a random search for the table's voxel and column
// counts, for a lowest point some 4 % of the length off the centre of mass, and for Izz above Iyy so that
// hollowing can make it the largest. Those counts fill 35 % of the box with what lies 1.5 cells deep, which
// is why the bird is plump. The rest was drawn by hand: the head looks to the side and one wing is larger and
// higher, so no plane of symmetry is left and no product of inertia vanishes.

/// An ellipsoid; angles in degrees, applied roll, pitch, yaw.
struct Part {
  Vec3 centre, semi_axes;
  double yaw, pitch, roll;  // to the left (+y), beak up, left wing up
};

constexpr double degree = std::numbers::pi / 180.0;

const std::array<Part, 6> parts = {{
    {{0.0, 0.0, -3.0}, {36.2, 28.6, 24.9}, 0.0, 9.4, 0.0},      // body (fit)
    {{21.8, 6.0, 19.7}, {17.28, 16.0, 16.0}, 10.0, 0.0, 0.0},   // head (fit but for its turn)
    {{36.8, 10.5, 19.7}, {11.0, 5.5, 5.5}, 18.0, 15.0, 0.0},    // beak
    {{-26.4, 0.0, 7.7}, {16.9, 18.0, 9.3}, 0.0, -25.0, 0.0},    // tail (fit)
    {{-1.1, 14.0, 7.8}, {31.3, 21.4, 16.1}, -8.0, 0.0, 51.7},   // left wing (fit)
    {{-1.1, -14.0, 5.8}, {31.3, 20.4, 16.1}, 8.0, 0.0, -49.7},  // right wing, a little smaller and lower
}};

// How sharply the parts meet: below about 8 head and beak melt into one. Rays from the centre cross the
// groove under the beak at a slope of no less than 0.07 (cosine to the normal); at 20 it would be 0.02.
constexpr double sharpness = 12.0;

// Box of the drawing, found on a mesh of it, and the box it is mapped to.
const Vec3 drawn_lo(-42.2239, -32.4382, -28.2673);
const Vec3 drawn_extent(89.3623, 65.1251, 63.9684);
const Vec3 box_mm(60.0, 45.0, 45.0);

constexpr double far_out = 60.0;  // mm, beyond the surface in every direction
constexpr int halvings = 48;      // 60 mm / 2^48 is 2e-13 mm

struct Placed {
  Eigen::Matrix3d to_ball;  // turns and scales the ellipsoid to the unit ball
  Vec3 centre;
};

Placed place(const Part& part) {
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(part.yaw * degree, Vec3::UnitZ()) *
                                Eigen::AngleAxisd(part.pitch * degree, -Vec3::UnitY()) *
                                Eigen::AngleAxisd(part.roll * degree, Vec3::UnitX()))
                                   .toRotationMatrix();
  return {part.semi_axes.cwiseInverse().asDiagonal() * turn.transpose(), part.centre};
}

const std::array<Placed, parts.size()>& placed_parts() {
  static const auto placed = [] {
    std::array<Placed, parts.size()> out;
    for (std::size_t i = 0; i < parts.size(); ++i) out[i] = place(parts[i]);
    return out;
  }();
  return placed;
}

/// The surface along the ray from the centre; one crossing, as the shape is star-shaped.
Vec3 march(const Vec3& direction) {
  double inside = 0.0, outside = far_out;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    (bird_field(bird_centre() + middle * direction) > 0 ? inside : outside) = middle;
  }
  return bird_centre() + inside * direction;
}

}  // namespace

Vec3 bird_centre() { return (-drawn_lo).cwiseQuotient(drawn_extent).cwiseProduct(box_mm); }

double bird_field(const Vec3& point) {
  const Vec3 p = drawn_lo + point.cwiseQuotient(box_mm).cwiseProduct(drawn_extent);
  double sum = 0.0;  // smooth union: the largest of exp(-sharpness * distance) leads, near a seam two add up
  for (const Placed& part : placed_parts())
    sum += std::exp(-sharpness * ((part.to_ball * (p - part.centre)).norm() - 1.0));
  return std::log(sum);
}

TriangleMesh bird_shape(int fineness) { return wrap_geodesic(fineness, march); }

}  // namespace kreisel::core
