#include "deform/shape.hpp"

#include <gtest/gtest.h>

#include "body/mesh_moments.hpp"
#include "deform/bodies.hpp"
#include "test_device.hpp"

namespace kreisel::core {
namespace THIS_FILE {

Body ellipsoid(std::uint32_t around) {
  BodySpec spec;
  spec.density = 1;
  return make_body(spec, source_of(leaning_ellipsoid({18, 15, 22}, 20, around)));
}

ShapeRays rays_of(const Body& body, int cells) {
  GridSpec grid;
  grid.resolution = cells;
  return shape_rays(body, grid, {1.5, Wall::millimetres}, 0.1);
}

TEST(InnerSurface, OfASphereHasTheAreaAndNormalsOfTheSmallerSphere) {
  const double radius = 2, wall = 0.3;
  const TriangleMesh sphere = leaning_ellipsoid(Vec3::Constant(radius), 0, 96);
  double area = 0, volume = 0;
  Vec3 sum = Vec3::Zero();
  for (const InnerPiece& piece : inner_surface(sphere, wall, 2 * radius / 64)) {
    area += piece.area;
    volume += piece.area * piece.normal.dot(piece.at) / 3;
    sum += piece.area * piece.normal;
    EXPECT_NEAR(piece.barycentric[0] + piece.barycentric[1] + piece.barycentric[2], 1, 1e-9);
  }
  const double inner = radius - wall;
  // The rule of the rays converges as h; the polyhedron is smaller by its sagitta.
  EXPECT_NEAR(area, 4 * std::numbers::pi * inner * inner, 0.005 * area);
  EXPECT_NEAR(volume, 4.0 / 3 * std::numbers::pi * inner * inner * inner, 0.005 * volume);
  EXPECT_LT(sum.norm(), 1e-2 * area);
}

TEST(InnerSurface, HangsOnTheSkinWhereItIsNearest) {
  const TriangleMesh box = box_mesh({-1, -1, -1}, {1, 1, 1});
  for (const InnerPiece& piece : inner_surface(box, 0.25, 0.07)) {
    Vec3 foot = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) foot += piece.barycentric[k] * box.vertices[piece.corners[k]];
    EXPECT_NEAR((foot - piece.at).norm(), 0.25, 1e-9);
    EXPECT_LT((piece.at + 0.25 * piece.normal - foot).norm(), 1e-9);
  }
}

/// A motion that fades away before the rim, so that no ray appears or vanishes.
TriangleMesh swollen(const TriangleMesh& mesh, double by) {
  TriangleMesh result = mesh;
  for (Vec3& v : result.vertices) {
    const double r = v.head<2>().norm(), fade = std::max(0.0, 1 - r * r / 0.12);
    v += by * fade * fade * Vec3(0.3 * v[2], -0.2, 1 + v[0] + 0.5 * v[2]);
  }
  return result;
}

TEST(Shape, HasTheDerivativeOfItsOwnRays) {
  Body body = ellipsoid(48);
  // The axis through the middle, so that the motion is about it.
  reframe(body, Body(body), Vec3::UnitZ(), Vec3::Zero());
  const ShapeRays rays = rays_of(body, 40);
  Random random(8);
  for (const double void_density : {0.0, 0.4}) {
    body.void_density = void_density;
    Moments q;
    for (double& c : q) c = uniform(random, -1, 1);
    q[SYY] = -q[SXX];  // then the mean of q over a column is its value in the middle
    const Shape shape(body, body.local, rays, test_device());
    const std::vector<Vec3> gradient = shape.gradient_of_least(q, ray_ends(body.local, shape.domain()));
    const double h = 1e-5;
    double along = 0;
    const TriangleMesh unit = swollen(body.local, 1);
    for (std::size_t i = 0; i < gradient.size(); ++i)
      along += gradient[i].dot(unit.vertices[i] - body.local.vertices[i]);
    const double more = Shape(body, swollen(body.local, h), rays, test_device()).least(q),
                 less = Shape(body, swollen(body.local, -h), rays, test_device()).least(q);
    EXPECT_NEAR(along, (more - less) / (2 * h), 1e-5 * std::abs(along)) << void_density;
  }
}

TEST(Shape, HasTheDerivativeOfTheSurfaceWhicheverWayItMoves) {
  const Body body = ellipsoid(64);
  const ShapeRays rays = rays_of(body, 128);
  const Shape shape(body, body.local, rays, test_device());
  Random random(9);
  for (int trial = 0; trial < 3; ++trial) {
    Moments q;
    for (double& c : q) c = uniform(random, -1, 1);
    Eigen::Matrix3d stretch;
    for (double& a : stretch.reshaped()) a = uniform(random, -1, 1);
    const std::vector<Vec3> gradient = shape.gradient_of_least(q);
    double along = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
      along += gradient[i].dot(stretch * body.local.vertices[i]);
    const auto least = [&](double by) {
      TriangleMesh moved = body.local;
      for (Vec3& v : moved.vertices) v += by * stretch * v;
      return Shape(body, moved, rays, test_device()).least(q);
    };
    // On a grid the value itself scatters by 1e-4 of the body's moments; over a step of 0.04 that is 5e-3 of
    // them.
    const double h = 0.02, size = q.cwiseAbs().dot(reference::mesh_moments(body.local).abs_sum);
    EXPECT_NEAR(along, (least(h) - least(-h)) / (2 * h), 5e-3 * size) << trial;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
