#include "nest/search/layers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/shapes.hpp"
#include "nest/decide/exact.hpp"
#include "nest/known_answers.hpp"
#include "refusal.hpp"
#include "test_device.hpp"

namespace kreisel::core::nest {
namespace THIS_FILE {

LayersSpec quick(double size, Tolerances tolerances) {
  LayersSpec spec;
  spec.size = size;
  spec.tolerances = tolerances;
  spec.cells = 32;
  spec.search.freedom.set_free("position,centroid-plane");
  spec.search.search.swarm.particles = 16;
  spec.search.search.swarm.iterations = 4;
  spec.search.search.climb.iterations = 25;
  return spec;
}

TriangleMesh seen_in_world(TriangleMesh mesh, const Eigen::Affine3d& map) {
  for (Vec3& v : mesh.vertices) v = map * v;
  return mesh;
}

TEST(Layers, OfABallAreThinnerByTheTolerancesUntilNoWallIsLeft) {
  // Diameter 20: walls of 1.5 and 0.5 for the printer leave radii of 8, 6, 4 and 2; that is all wall.
  const LayersSpec spec = quick(20, {.accuracy = 0.5, .wall = 1.5});
  const Layers found = nest_layers({ball(6)}, test_device(), spec);
  ASSERT_EQ(found.layers.size(), 4u) << found.ended;
  EXPECT_NE(found.ended.find("nowhere deeper than"), std::string::npos) << found.ended;
  EXPECT_FALSE(found.interrupted);
  double radius = 10;
  for (const Layer& layer : found.layers) {
    const double voxel = 2 * radius / spec.cells;
    radius -= 2;
    // A quarter of a voxel at the inset, and the sagitta of a mesh of frequency 6, 0.4 % of the radius; the
    // rest is what so short a search leaves. It all adds up from layer to layer.
    const double lost = (10 - radius) / 2 * (0.25 * voxel + 0.004 * radius + 0.02 * radius);
    EXPECT_LT(layer.scale, radius + 0.004 * radius);
    EXPECT_GT(layer.scale, radius - lost);
    EXPECT_GE(layer.certified_scale, layer.scale);
    EXPECT_GE(layer.thickness, 1.5);
    EXPECT_LT(layer.thickness, 1.5 + lost);
    EXPECT_EQ(layer.outer, 0u);
    EXPECT_EQ(layer.inner, 0u);
    EXPECT_NEAR(std::cbrt(layer.inner_to_world.linear().determinant()), layer.scale, 1e-9);
    radius = layer.scale;
  }
}

TEST(Layers, OfDifferentShapesLieInEachOtherInTurn) {
  // A cube of 40 around a ball around a small box, which then goes into itself once.
  const std::vector<TriangleMesh> shapes = {box_mesh({0, 0, 0}, {4, 4, 4}), ball(8),
                                            box_mesh({5, 5, 5}, {6, 7, 6})};
  LayersSpec spec = quick(40, {.accuracy = 0.2, .wall = 0.8});
  spec.most = 3;
  const Layers found = nest_layers(shapes, test_device(), spec);
  ASSERT_EQ(found.layers.size(), 3u) << found.ended;
  EXPECT_EQ(found.ended, "3 layers were asked for");
  Eigen::Affine3d outer_to_world = found.outermost;
  for (std::size_t k = 0; k < 3; ++k) {
    const Layer& layer = found.layers[k];
    EXPECT_EQ(layer.outer, k);
    EXPECT_EQ(layer.inner, std::min<std::size_t>(k + 1, 2));
    const TriangleMesh outer = seen_in_world(shapes[layer.outer], outer_to_world);
    const TriangleMesh inner = seen_in_world(shapes[layer.inner], layer.inner_to_world);
    EXPECT_GT(winding_number(outer, inner.vertices.front()), 0.5);
    const double step = 0.1;
    EXPECT_NEAR(clearance(outer, inner, layer.cut, step) - 0.2, layer.thickness, step);
    EXPECT_GE(layer.thickness, 0.8);
    EXPECT_NEAR(
        layer.ratio,
        bounding_box(seen_in_world(shapes[layer.inner], Eigen::Affine3d(Eigen::Scaling(layer.scale))))
                .extent()
                .maxCoeff() /
            bounding_box(seen_in_world(shapes[layer.outer], Eigen::Affine3d(Eigen::Scaling(std::cbrt(
                                                                outer_to_world.linear().determinant())))))
                .extent()
                .maxCoeff(),
        1e-9);
    outer_to_world = layer.inner_to_world;
  }
  EXPECT_NEAR(found.layers[0].scale, 19, 0.03 * 19) << "the cube of 38's inscribed ball";
}

TEST(Layers, WithoutTolerancesAreWhatOneSearchFinds) {
  LayersSpec spec = quick(0, {});
  spec.most = 1;
  const Layers found = nest_layers({ball(6, {1.5, 1.2, 1}), ball(6)}, test_device(), spec);
  ASSERT_EQ(found.layers.size(), 1u) << found.ended;
  EXPECT_NEAR(found.layers[0].scale, 1, 0.03) << "the smallest half-axis";
  EXPECT_GT(found.layers[0].thickness, 0);
}

TEST(Layers, EndWhereTheNextShapeWouldBeThinnerThanAWall) {
  // Into a ball of 10 with walls of 2 goes a needle of 1 by 20 at half its size at most.
  LayersSpec spec = quick(20, {.accuracy = 0, .wall = 2});
  const Layers found = nest_layers({ball(8), box_mesh({0, 0, 0}, {1, 1, 20})}, test_device(), spec);
  EXPECT_EQ(found.layers.size(), 0u);
  EXPECT_NE(found.ended.find("less than the least wall of 2 mm"), std::string::npos) << found.ended;
}

TEST(Layers, StopWhenTold) {
  int told = 0;
  const Layers found = nest_layers({ball(6)}, test_device(), quick(20, {.accuracy = 0.5, .wall = 0.5}),
                                   [&](int layer, const SearchState&) { return ++told < 3 && layer == 1; });
  EXPECT_TRUE(found.interrupted);
  EXPECT_LE(found.layers.size(), 1u);
  EXPECT_EQ(told, 3);
}

TEST(Layers, RefuseWhatIsNoTolerance) {
  const auto nest = [](const LayersSpec& spec) { (void)nest_layers({ball(3)}, test_device(), spec); };
  expect_refusal([&] { nest(quick(10, {.accuracy = -1, .wall = 0})); }, "printer's accuracy -1 mm", {});
  expect_refusal([&] { nest(quick(10, {.accuracy = 0, .wall = NAN})); }, "wall nan mm", {});
  expect_refusal([&] { nest(quick(-3, {})); }, "size -3 mm", {});
  LayersSpec none = quick(10, {});
  none.most = 0;
  expect_refusal([&] { nest(none); }, "layers 0", {});
  TriangleMesh hollow = ball(3), cavity = inverted(ball(3));
  for (Vec3& v : cavity.vertices) v *= 0.5;
  expect_refusal(
      [&] {
        (void)nest_layers({both(hollow, cavity)}, test_device(), quick(10, {.accuracy = 0, .wall = 1}));
      },
      "a shape has a cavity", {});
  expect_refusal([&] { (void)nest_layers({}, test_device(), quick(10, {})); }, "layers of no shape", {});
}

TEST(Clearance, IsThatOfTheWholeWayOut) {
  // A box of half-side 1 with a spike to x = 0.5 at mid-height; a ball above it comes by on its way down.
  const TriangleMesh outer = spiked_box(0.5, 0.01);
  const TriangleMesh inner = moved(ball(6, Vec3::Constant(0.1)), Eigen::Matrix3d::Identity(), {0.2, 0, 0.5});
  const double step = 0.01;
  const auto at_cut = [&](double z) {
    return clearance(outer, inner, Cut::through(Vec3(0, 0, z), Vec3::UnitZ()), step);
  };
  // Of the mesh's vertices some are within 10 degrees of the ball's side, and 0.0015 short of it.
  EXPECT_NEAR(at_cut(-0.5), 0.2, 0.0015 + step * step / 0.4);
  EXPECT_NEAR(at_cut(0.6), 0.4, 0.0015) << "on its way up and out the lid is nearest";
}

}  // namespace THIS_FILE
}  // namespace kreisel::core::nest
