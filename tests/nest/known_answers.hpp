// known_answers.hpp - nestings whose answers follow from geometry.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "body/models/geodesic.hpp"
#include "body/models/revolve.hpp"
#include "body/test_meshes.hpp"
#include "nest/decide/nesting.hpp"

namespace kreisel::core::nest {

inline TriangleMesh ball(int frequency, const Vec3& radii = Vec3::Ones()) {
  return wrap_geodesic(frequency, [&](const Vec3& u) -> Vec3 { return u.cwiseProduct(radii); });
}

/// About the z-axis.
inline TriangleMesh ring(double major, double minor, int around = 96, int across = 32) {
  return moved(upright_torus_mesh(major, minor, around, across),
               Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero());
}

inline TriangleMesh cylinder(double radius, double height, int count = 96) {
  return revolve(
      {{0, -height / 2, 1}, {radius, -height / 2, count}, {radius, height / 2, count}, {0, height / 2, 1}});
}

/// The unit sphere with its equator along edges: cut there, both halves are as wide as they get.
inline TriangleMesh globe(int rings = 24) {
  std::vector<Ring> all{{0, -1, 1}};
  for (int k = 1; k < rings; ++k) {
    const double t = std::numbers::pi * (double(k) / rings - 0.5);
    all.push_back({std::cos(t), std::sin(t), 2 * rings});
  }
  all.push_back({0, 1, 1});
  return revolve(all);
}

/// A cap of radius 1 with its underside at z = 0 on a stem of radius 0.3 down to z = -1.
inline TriangleMesh mushroom() {
  std::vector<Ring> rings{{0, -1, 1}, {0.3, -1, 64}, {0.3, 0, 64}};
  for (int k = 0; k < 16; ++k) {
    const double t = std::numbers::pi / 2 * k / 16;
    rings.push_back({std::cos(t), std::sin(t), 64});
  }
  rings.push_back({0, 1, 1});
  return revolve(rings);
}

/// The box [-1, 1]^3, its face at x = 1 pushed in to a thin spike of half-width `width` with its apex at x.
inline TriangleMesh spiked_box(double x, double width) {
  TriangleMesh mesh = box_mesh(Vec3::Constant(-1), Vec3::Constant(1));
  mesh.triangles.resize(10);  // without the face at x = 1, vertices 1 3 7 5
  for (const auto& [y, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    mesh.vertices.emplace_back(1, y * width, z * width);
  mesh.vertices.emplace_back(x, 0, 0);
  const std::uint32_t outer[4] = {1, 3, 7, 5};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    mesh.triangles.push_back({outer[k], outer[next], 8 + next});
    mesh.triangles.push_back({outer[k], 8 + next, 8 + k});
    mesh.triangles.push_back({8 + k, 8 + next, 12});
  }
  return mesh;
}

/// B's origin lies at a place in A's coordinates, and so does the cut.
struct KnownAnswer {
  std::string name;
  TriangleMesh outer, inner;
  Vec3 origin = Vec3::Zero();
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
  std::vector<std::pair<double, bool>> answers;  ///< scale, whether it nests
  std::vector<Vec3> removal = {};                ///< plus and minus; default along the normal

  [[nodiscard]] Placement at(const Nesting& nesting, double scale) const {
    Placement placement{{}, Cut::through(nesting.to_units(point), normal)};
    placement.pose.scale = scale;
    placement.pose.centroid = nesting.to_units(origin + scale * nesting.inner_centroid());
    if (!removal.empty()) placement.cut.plus = removal[0], placement.cut.minus = removal[1];
    return placement;
  }
};

/// Of shapes without details finer than their triangles. The margins are wider than a pixel of a 512 x 512
/// view and the sagitta of the meshes together.
inline std::vector<KnownAnswer> known_answers() {
  const TriangleMesh sphere = ball(20), tube = ring(0.7, 0.3), cap = mushroom(), can = cylinder(0.5, 1);
  const double tilt = 0.5;
  const Vec3 tilted(std::sin(tilt), 0, std::cos(tilt)), down = -Vec3::UnitZ();
  std::vector<KnownAnswer> all;
  const auto around = [](double scale) {
    return std::vector{std::pair{scale - 0.01, true}, {scale + 0.01, false}};
  };
  all.push_back({"a sphere in itself",
                 globe(),
                 globe(),
                 {0, 0, 0},
                 {0, 0, 0},
                 {0, 0, 1},
                 {{0.5, true}, {0.999, true}, {1, false}, {1.001, false}}});
  all.push_back({"off-centre by 0.3", sphere, sphere, {0.3, 0, 0}, {0, 0, 0}, {0, 0, 1}, around(0.7)});
  all.push_back({"cut at 0.6", sphere, sphere, {0, 0, 0}, {0, 0, 0.6}, {0, 0, 1}, around(0.8)});
  all.push_back({"plus tilted",
                 sphere,
                 sphere,
                 {0, 0, 0},
                 {0, 0, 0},
                 {0, 0, 1},
                 around(std::cos(tilt)),
                 {tilted, down}});
  all.push_back(
      {"sphere in ellipsoid", ball(20, {1.5, 1.2, 1}), sphere, {0, 0, 0}, {0, 0, 0}, {0, 0, 1}, around(1)});
  all.push_back(
      {"plane misses B", sphere, sphere, {0, 0, 0}, {0, 0, 0.5}, {0, 0, 1}, {{0.2, true}, {0.49, true}}});
  all.push_back(
      {"opening of 0.312", sphere, sphere, {0, 0, 0}, {0, 0, 0.95}, {0, 0, 1}, {{0.2, true}, {0.33, false}}});
  all.push_back(
      {"plane misses A", sphere, sphere, {0, 0, 0}, {0, 0, 1.5}, {0, 0, 1}, {{0.2, false}, {0.01, false}}});
  all.push_back({"B outside A", sphere, sphere, {3, 0, 0}, {0, 0, 0}, {0, 0, 1}, {{0.2, false}, {1, false}}});
  all.push_back(
      {"B outside A, inside its box", sphere, sphere, {0.9, 0.9, 0}, {0, 0, 0}, {0, 0, 1}, {{0.05, false}}});
  all.push_back(
      {"ring in ring",
       tube,
       ring(0.7, 0.2),
       {0, 0, 0},
       {0, 0, 0},
       {0, 0, 1},
       {{0.01, false}, {0.5, false}, {0.78, false}, {0.82, true}, {1, true}, {1.09, true}, {1.13, false}}});
  all.push_back({"mushroom cut in the cap", cap, cap, {0, 0, 0.05}, {0, 0, 0.1}, {0, 0, 1}, {{0.9, true}}});
  all.push_back(
      {"mushroom cut in the stem", cap, cap, {0, 0, 0.05}, {0, 0, -0.3}, {0, 0, 1}, {{0.9, false}}});
  all.push_back({"mushroom cut along its axis", cap, cap, {0, 0, 0.05}, {0, 0, 0}, {1, 0, 0}, {{0.9, true}}});
  all.push_back({"mushroom, minus oblique",
                 cap,
                 cap,
                 {0, 0, 0.05},
                 {0, 0, 0.1},
                 {0, 0, 1},
                 {{0.9, false}},
                 {Vec3::UnitZ(), Vec3(std::sin(tilt), 0, -std::cos(tilt))}});
  for (const auto& [shift, valid] : {std::pair{0.045, true}, {0.052, false}, {0.06, false}})
    all.push_back({"cylinder shifted", can, can, {shift, 0, 0}, {0, 0, 0}, {0, 0, 1}, {{0.9, valid}}});
  all.push_back({"wide spike",
                 spiked_box(0.5, 0.1),
                 box_mesh(Vec3::Constant(-1), Vec3::Constant(1)),
                 {0, 0, 0},
                 {0, 0, 0},
                 {0, 0, 1},
                 around(0.5)});
  return all;
}

}  // namespace kreisel::core::nest
