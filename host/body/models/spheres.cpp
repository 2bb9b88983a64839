#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "body/models/revolve.hpp"
#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

// The grid of [RayRep, table 1] is 51 x 101 x 101 cells: three equal balls as wide as the box is deep, along
// the diagonal of its yz-plane. About that line their union is a surface of revolution.
constexpr double side = 60.0, radius = side * 51 / 101 / 2;
const double spacing = (side - 2 * radius) / 2 * std::numbers::sqrt2;

/// Rings on a ball about `centre` on the axis, at `steps` equal angles after `from` up to `to`.
void add_rings(std::vector<Ring>& rings, double centre, double from, double to, int steps,
               const auto& count) {
  for (int i = 1; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;  // from the lower pole
    rings.push_back({radius * std::sin(angle), centre - radius * std::cos(angle), count(i)});
  }
}

}  // namespace

TriangleMesh spheres_shape(int fineness) {
  require_fineness(fineness, 9000);  // the counts stay in 32 bits
  // Six vertices more a ring up to the equator make even triangles round a pole; 35 k^2 triangles in all.
  const int k = std::max(1, int(std::lround(0.75 * fineness)));
  const double quarter = std::numbers::pi / 2, seam = std::acos(spacing / 2 / radius);  // from the axis
  const int below_seam = std::max(1, int(std::lround(k * (quarter - seam) / quarter)));
  const auto all = [&](int) { return 6 * k; };

  std::vector<Ring> rings = {{0, -spacing - radius, 1}};
  add_rings(rings, -spacing, 0, quarter, k, [](int i) { return 6 * i; });
  add_rings(rings, -spacing, quarter, 2 * quarter - seam, below_seam, all);
  add_rings(rings, 0, seam, 2 * quarter - seam, 2 * below_seam, all);
  add_rings(rings, spacing, seam, quarter, below_seam, all);
  add_rings(rings, spacing, quarter, 2 * quarter, k, [&](int i) { return i == k ? 1 : 6 * (k - i); });
  rings.back().radius = 0;

  TriangleMesh mesh = revolve(rings);
  const Eigen::Matrix3d lean =
      Eigen::AngleAxisd(-std::numbers::pi / 4, Vec3::UnitX()).toRotationMatrix();  // z to (0, 1, 1)
  for (Vec3& v : mesh.vertices) v = lean * v + Vec3(radius, side / 2, side / 2);
  return mesh;
}

}  // namespace kreisel::core
