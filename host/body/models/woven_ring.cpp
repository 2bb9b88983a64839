#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "body/models/shapes.hpp"

namespace kreisel::core {
namespace {

// A Turk's head: one strand goes round three times while it weaves five times in and out and ten times over
// and under, so that three strands lie side by side, a third of a weave apart. Millimetres. Strands come no
// nearer than 6.4 mm to each other, and the curve bends no tighter than a radius of 5 mm.
constexpr int laps = 3, weaves = 5;
constexpr double ring_radius = 20.38251, sideways = 7.5, up_down = 4.2, strand_radius = 2.7;
const Vec3 middle(30.0, 30.58251, up_down + strand_radius);  // the box begins at the origin

Vec3 curve(double t) {
  const double rho = ring_radius + sideways * std::sin(weaves * t);
  return middle +
         Vec3(rho * std::cos(laps * t), rho * std::sin(laps * t), up_down * std::sin(2 * weaves * t));
}

Vec3 tangent(double t) {
  const double rho = ring_radius + sideways * std::sin(weaves * t);
  const double rate = sideways * weaves * std::cos(weaves * t);
  const double c = std::cos(laps * t), s = std::sin(laps * t);
  return Vec3(rate * c - laps * rho * s, rate * s + laps * rho * c,
              2 * weaves * up_down * std::cos(2 * weaves * t))
      .normalized();
}

/// v carried along the curve with as little turning as possible: reflected in the plane between the points,
/// then in the one between the tangents (double reflection, fourth order in the step).
Vec3 carried(const Vec3& v, const Vec3& step, const Vec3& from, const Vec3& to) {
  const auto reflect = [](const Vec3& x, const Vec3& n) -> Vec3 {
    return x - 2 * x.dot(n) / n.squaredNorm() * n;
  };
  return reflect(reflect(v, step), to - reflect(from, step));
}

}  // namespace

TriangleMesh woven_ring_shape(int fineness) {
  require_fineness(fineness, 4000);
  const int around = std::max(6, int(std::lround(0.65 * fineness)));
  const int along = 15 * std::max(fineness, 12);  // fewer would cut the bends so short that strands touch
  const auto at = [&](int i) { return 2 * std::numbers::pi * i / along; };

  std::vector<Vec3> normals = {tangent(0).unitOrthogonal()};
  for (int i = 0; i < along; ++i)
    normals.push_back(
        carried(normals.back(), curve(at(i + 1)) - curve(at(i)), tangent(at(i)), tangent(at(i + 1))));
  // The frame comes back turned by some angle; give every step its share of it.
  const Vec3 start = tangent(0), last = normals.back();
  const double turned = std::atan2(start.dot(last.cross(normals[0])), last.dot(normals[0]));

  TriangleMesh mesh;
  for (int i = 0; i < along; ++i) {
    const Vec3 t = tangent(at(i)), u = normals[std::size_t(i)], v = t.cross(u);
    for (int j = 0; j < around; ++j) {
      const double angle = 2 * std::numbers::pi * j / around + turned * i / along;
      mesh.vertices.push_back(curve(at(i)) + strand_radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  const auto index = [&](int i, int j) { return std::uint32_t(i % along * around + j % around); };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i + 1, j)});
      mesh.triangles.push_back({index(i, j), index(i, j + 1), index(i + 1, j + 1)});
    }
  return mesh;
}

}  // namespace kreisel::core
